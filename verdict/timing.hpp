#pragma once
// Timing of a run as the two programs report it at their end (their --json files).
//
// Units      ns as in the reports. Absent figures stay empty: lockstep has no wake-up, a rig that
//            was not started here sends no report.
// Failure    BadInput when a report exists but is not what the program writes.
// Thread     any; offline.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace levitas::verdict {

struct DurationFigures {
  std::string name;  ///< "wakeup", "compute", "latency", or the stage of the cycle
  std::uint64_t count{};
  double p50_ns{}, p99_ns{}, p999_ns{}, max_ns{};
};

struct TimingFigures {
  std::string pace;
  std::uint64_t cycles{};
  double wall_s{};           ///< from the first to the last cycle
  double cycles_per_s{};     ///< of wall-clock time
  double times_real_time{};  ///< simulated time over wall-clock time
  std::vector<DurationFigures> durations;
  std::optional<std::uint64_t> skipped_periods;
  std::string blamed_stage;  ///< of the last overrun; empty or "none" when there was none
  std::optional<std::uint64_t> lost_records;     ///< the recording thread could not take
  std::optional<std::uint64_t> rejected_frames;  ///< undecodable, at either end
  std::vector<std::string> degradations;  ///< what the machine refused (real-time priority ...)
};

/// Empty when there is no such file: the program was killed before it could write it.
[[nodiscard]] std::optional<TimingFigures> ReadControllerReport(const std::string& path);

}  // namespace levitas::verdict
