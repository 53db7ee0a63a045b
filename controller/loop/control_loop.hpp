#pragma once
// The loop around the control cycle: read -> (check, supervise, law) -> write -> record.
//
// Lockstep  a frame is a cycle. A frame that comes a second time (the rig asks again because the
//           answer was lost) gets the same answer and is no new cycle.
// Real time a fixed grid, `phase_ns` after the rig's sampling instants. A frame that is not there
//           `grace_ns` after the wake-up is missing. The grid never moves: an overrun skips whole
//           periods, which are counted, told to the cycle and blamed on a stage.
//           A frame older than the last one, of the same start of the rig, came too late: it is
//           counted and missing.
//           A sampling instant further than `farthest_ns` from now (another machine's clock, a
//           sender gone wrong) is none: the frame's arrival less `phase_ns` takes its place, and is
//           counted.
// Thread    Run in one thread; no allocation, lock or exception between its first and last cycle.
//           Abort and frames_heard from any thread.
// Failure   none of its own: a silent rig shows in frames_heard, and the caller decides.

#include <atomic>
#include <cstdint>

#include "common/rig_port.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "controller/loop/loop_statistics.hpp"
#include "controller/loop/operator_source.hpp"
#include "rt/clock.hpp"

namespace levitas::loop {

enum class Pace : std::uint8_t { kLockstep, kRealtime };

/// Takes what leaves the loop; must neither wait nor allocate.
class RecordSink {
 public:
  virtual ~RecordSink() = default;
  virtual void Post(const cycle::CycleRecord& record) noexcept = 0;
  /// Torsion measured beside the loop, before the record of the cycle whose frame came behind it.
  virtual void PostTorsion(const TorsionBatch& /*batch*/) noexcept {}
  /// About once a second of cycles.
  virtual void Post(const LoopStatistics& statistics) noexcept = 0;
};

struct LoopOptions {
  Pace pace{Pace::kLockstep};
  std::int64_t period_ns{100'000};
  std::int64_t phase_ns{30'000};  ///< rig's sampling instant -> wake-up: the frame's way here
  std::int64_t grace_ns{45'000};  ///< wake-up -> a frame not there is missing
  std::int64_t farthest_ns{1'000'000'000};  ///< of a sampling instant from now
};

class ControlLoop {
 public:
  /// Keeps references to all of them.
  ControlLoop(const LoopOptions& options, port::RigPort& port, cycle::ControlCycle& cycle,
              OperatorSource& source, RecordSink& sink, rt::Clock& clock) noexcept;

  /// Returns when the operator is done, or after Abort.
  void Run() noexcept;
  /// Ends Run within a tenth of a second, whatever the rig does.
  void Abort() noexcept { aborted_.store(true, std::memory_order_relaxed); }

  /// Sensor frames so far.
  [[nodiscard]] std::uint64_t frames_heard() const noexcept {
    return heard_.load(std::memory_order_relaxed);
  }
  /// Loop thread, or after Run.
  [[nodiscard]] const LoopStatistics& statistics() const noexcept { return statistics_; }
  [[nodiscard]] const cycle::CycleRecord& last() const noexcept { return record_; }

 private:
  void RunLockstep() noexcept;
  void RunRealtime() noexcept;
  /// Waits for the first frame; false when aborted before.
  [[nodiscard]] bool AwaitFrame(SensorFrame& frame) noexcept;
  /// Real time: gives a frame that came now an instant of sampling that can be.
  void Date(SensorFrame& frame) noexcept;
  [[nodiscard]] bool Repeated(const SensorFrame& frame) const noexcept;
  /// Of the same rig and older than the frame of the latest cycle.
  [[nodiscard]] bool Overtaken(const SensorFrame& frame) const noexcept;
  /// Real time: the newest frame; false when it is none that was not there before.
  [[nodiscard]] bool ReadNew(SensorFrame& frame, std::int64_t deadline_ns) noexcept;
  void Cycle(bool frame_present, const SensorFrame& frame, std::uint32_t missed) noexcept;
  void CountOverrun(std::int64_t skipped) noexcept;
  [[nodiscard]] bool Ends() const noexcept {
    return source_.Done() || aborted_.load(std::memory_order_relaxed);
  }

  LoopOptions options_;
  port::RigPort& port_;
  cycle::ControlCycle& cycle_;
  OperatorSource& source_;
  RecordSink& sink_;
  rt::Clock& clock_;
  LoopStatistics statistics_;
  StageTimer timer_;
  cycle::CycleRecord record_;
  TorsionBatch torsion_;
  bool answered_{false};
  std::int64_t written_ns_{0};  ///< when the current of the last cycle had been sent
  std::uint64_t cycles_per_second_;
  std::atomic<std::uint64_t> heard_{0};
  std::atomic<bool> aborted_{false};
};

}  // namespace levitas::loop
