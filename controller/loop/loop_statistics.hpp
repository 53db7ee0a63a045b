#pragma once
// What the loop measured of itself since its start.
//
// Units    nanoseconds in the histograms (common/histogram.hpp).
// Thread   written by the loop thread; copied there, or read after the loop has ended.

#include <algorithm>
#include <array>
#include <cstdint>

#include "common/histogram.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "rt/clock.hpp"

namespace levitas::loop {

struct LoopStatistics {
  std::uint64_t cycles{};
  std::int64_t first_ns{};          ///< CLOCK_MONOTONIC at the first cycle ...
  std::int64_t last_ns{};           ///< ... and at the last
  std::uint64_t skipped_periods{};  ///< of the grid, in which no cycle was started
  std::uint64_t overruns{};         ///< cycles that caused them
  std::uint64_t missing_frames{};   ///< cycles without a new sensor frame
  std::uint64_t undated_frames{};   ///< of which the sampling instant made no sense (real time)
  std::uint64_t old_frames{};       ///< older than one that was there before: not used
  std::uint64_t repeated_frames{};  ///< asked again in lockstep: answered again, no cycle
  Histogram wakeup;                 ///< grid instant -> awake (real time)
  Histogram compute;                ///< frame read -> current written
  Histogram latency;                ///< sampling instant -> current written (real time)
  Histogram emergency_stop;         ///< operator's stop received -> the trip's current written
  std::array<Histogram, cycle::kStageCount> stage;
  std::array<std::uint64_t, cycle::kStageCount> blamed{};  ///< overruns by stage
  cycle::Stage last_blamed{cycle::Stage::kNone};
};

/// Takes a time stamp at the end of each stage, for the histograms and for blame.
class StageTimer final : public cycle::StageObserver {
 public:
  StageTimer(rt::Clock& clock, LoopStatistics& statistics) noexcept
      : clock_(clock), statistics_(statistics) {}

  /// A new cycle: stages are measured from `from_ns` on.
  void Start(std::int64_t from_ns) noexcept {
    last_ns_ = from_ns;
    duration_ns_.fill(0);
  }
  void Ended(cycle::Stage stage) noexcept override {
    const std::int64_t now_ns = clock_.NowNs();
    const auto at = static_cast<std::size_t>(stage);
    duration_ns_[at] += now_ns - last_ns_;
    statistics_.stage[at].Add(now_ns - last_ns_);
    last_ns_ = now_ns;
  }
  [[nodiscard]] std::int64_t last_ns() const noexcept { return last_ns_; }
  /// The stage of this cycle that took longest.
  [[nodiscard]] cycle::Stage Longest() const noexcept {
    const auto longest = std::max_element(duration_ns_.begin(), duration_ns_.end());
    return static_cast<cycle::Stage>(longest - duration_ns_.begin());
  }

 private:
  rt::Clock& clock_;
  LoopStatistics& statistics_;
  std::int64_t last_ns_{0};
  std::array<std::int64_t, cycle::kStageCount> duration_ns_{};
};

/// "check", "law" ...
[[nodiscard]] constexpr const char* StageName(cycle::Stage stage) noexcept {
  constexpr std::array kNames{"none",      "wait", "read",  "check",
                              "supervise", "law",  "write", "record"};
  static_assert(kNames.size() == cycle::kStageCount);
  return kNames[static_cast<std::size_t>(stage)];
}

}  // namespace levitas::loop
