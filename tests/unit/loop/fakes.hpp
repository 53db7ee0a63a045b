#pragma once
// A clock that only moves when somebody waits or works, and a rig that answers as it is told.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "controller/loop/control_loop.hpp"

namespace levitas::loop::test {

class FakeClock final : public rt::Clock {
 public:
  std::int64_t NowNs() noexcept override { return now_ns; }
  void SleepUntil(std::int64_t due_ns) noexcept override {
    now_ns = std::max(now_ns, due_ns);
    if (on_wake) on_wake();
  }
  std::int64_t now_ns{0};
  std::function<void()> on_wake;  ///< may move the clock on: a late wake-up
};

/// Gives one frame per period of its own grid; hooks spoil it.
class FakePort final : public port::RigPort {
 public:
  FakePort(FakeClock& clock, std::int64_t period_ns) : clock_(clock), period_ns_(period_ns) {}

  port::ReadResult Read(SensorFrame& frame, std::int64_t deadline_ns) noexcept override {
    ++reads;
    if (on_read) on_read();
    if (silent && silent()) {
      clock_.now_ns = std::max(clock_.now_ns, deadline_ns);
      return port::ReadResult::kNothing;
    }
    if (!repeat) {
      next_.cycle =
          lockstep ? next_.cycle + 1 : static_cast<std::uint64_t>(clock_.now_ns / period_ns_);
      next_.sample_time_ns = static_cast<std::int64_t>(next_.cycle) * period_ns_;
    }
    repeat = false;
    next_.rig_session = 1;
    next_.axes = 4;
    frame = next_;
    if (date) frame.sample_time_ns = date(frame.sample_time_ns);
    return port::ReadResult::kFrame;
  }
  bool Write(const CurrentFrame& frame) noexcept override {
    if (on_write) on_write();
    written.push_back(frame.cycle);
    return true;
  }
  [[nodiscard]] port::PortCounters counters() const noexcept override { return {}; }

  std::function<bool()> silent;
  std::function<std::int64_t(std::int64_t)> date;  ///< what a frame says instead of the truth
  std::function<void()> on_read;
  std::function<void()> on_write;
  bool lockstep{false};
  bool repeat{false};  ///< the next frame is the previous one again
  std::uint64_t reads{0};
  std::vector<std::uint64_t> written;

 private:
  FakeClock& clock_;
  std::int64_t period_ns_;
  SensorFrame next_;
};

class FakeSink final : public RecordSink {
 public:
  void Post(const cycle::CycleRecord& record) noexcept override {
    records.push_back(record);
    if (on_record) on_record();
  }
  void Post(const LoopStatistics& statistics) noexcept override {
    reported.push_back(statistics.cycles);
  }
  std::vector<cycle::CycleRecord> records;
  std::vector<std::uint64_t> reported;
  std::function<void()> on_record;
};

/// Asks for nothing and ends after some cycles.
class FakeSource final : public OperatorSource {
 public:
  explicit FakeSource(std::uint64_t cycles) : left_(cycles) {}
  cycle::OperatorInput Next(const OperatorView& view) noexcept override {
    views.push_back(view);
    --left_;
    return {};
  }
  [[nodiscard]] bool Done() const noexcept override { return left_ == 0; }
  std::vector<OperatorView> views;

 private:
  std::uint64_t left_;
};

}  // namespace levitas::loop::test
