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

/// From sample to current on a CAN bus [periods]: measured, and as margins are computed.
struct DelayFigures {
  std::uint64_t count{};
  double expected_periods{};
  double least_periods{}, median_periods{}, most_periods{};  ///< until the current acts
  std::string objection;                                     ///< empty: they agree
};

/// What the controller's process says of itself.
struct TimingFigures {
  std::uint64_t cycles{};
  double wall_s{};           ///< from the first to the last cycle
  double cycles_per_s{};     ///< of wall-clock time
  double times_real_time{};  ///< simulated time over wall-clock time
  std::vector<DurationFigures> durations;
  std::string blamed_stage;           ///< of most overruns; empty when there was none
  std::uint64_t lost_records{};       ///< the recording thread could not take
  std::uint64_t lost_messages{};      ///< gaps in the sequence of sensor frames
  std::uint64_t rejected_frames{};    ///< undecodable
  std::string real_time;              ///< what the machine granted and refused, one line per fact
  std::optional<DelayFigures> delay;  ///< real time, over CAN
  std::string trip_file;              ///< frozen by the first trip, empty if none
};

/// What the rig's process says of itself.
struct RigFigures {
  std::uint64_t cycles{};
  std::uint64_t held_currents{};   ///< periods that reused an old current
  std::uint64_t lost_messages{};   ///< gaps in the sequence of current frames
  std::uint64_t watchdog_trips{};  ///< amplifiers switched off for want of a controller
  DurationFigures advance;         ///< integration of one period
};

/// Empty when there is no such file: the program was killed before it could write it.
[[nodiscard]] std::optional<TimingFigures> ReadControllerReport(const std::string& path,
                                                                double period_s);
[[nodiscard]] std::optional<RigFigures> ReadRigReport(const std::string& path);

}  // namespace levitas::verdict
