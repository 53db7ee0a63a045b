#pragma once
// Gains over speed: a table of decentralised laws, each searched for its part of the speeds.
//
// Method     one law for all speeds first (pid_search.hpp); from it one for rest, from that one for
//            the next speed and so on, each against the plants between its two neighbours and the
//            corners there: neighbours are near one another and hold each other's speeds. What the
//            loop runs between two entries lies on the straight line between them
//            (law_schedule.hpp); where that does not hold the rig, or |S| leaves its limit, an
//            entry is added in the middle, three at most between two speeds that were asked for.
//            Intervals that still do not hold are returned in `open`.
// Judged     by the gate, not here: neighbours that hold are no proof of what lies between.
// Same seed  same laws. Failure and thread: as of SearchPid.

#include "design/pid/pid_search.hpp"

namespace levitas::design {

/// So many laws, that of rest included, a controller file takes (configuration/schema).
inline constexpr std::size_t kMostEntries = 33;

struct ScheduleOptions {
  PidSearchOptions search;               ///< `evaluations` for each entry and for the one law
  std::vector<double> speeds_rad_per_s;  ///< of the table, from rest, rising
};

struct ScheduleResult {
  PidSearchResult one;  ///< law for all speeds
  law::LawConfig law;   ///< the table
  /// Speeds [rad/s] between which no laws were found that hold everywhere.
  std::vector<std::pair<double, double>> open;
  std::size_t evaluations{};
  bool interrupted{};
};

[[nodiscard]] ScheduleResult SearchSchedule(
    const configuration::RigFile& rig, const PidLimits& limits,
    const std::vector<uncertainty::Parameter>& parameters, const ScheduleOptions& options,
    const std::function<bool(double, const std::string&)>& seen);

}  // namespace levitas::design
