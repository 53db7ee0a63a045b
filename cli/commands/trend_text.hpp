#pragma once
// The condition of geared shafts over sessions, as tables and verdict for people, as JSON, and as a
// picture.
// Thread  plain data.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/records/condition_trend.hpp"
#include "report/svg/figure.hpp"

namespace levitas::cli {

struct FollowedSession {
  std::string path;
  std::string label;  ///< short, of its own among the sessions
  analysis::GearCondition condition;
};

struct FollowedSessions {
  std::string rig;
  double speed_rad_per_s{};
  std::vector<FollowedSession> sessions;  ///< in order of time
  std::vector<std::string> reasons;       ///< why they cannot be compared; empty: they can
  std::vector<std::string> not_known;     ///< what no record says, in words
  analysis::TrendRule rule;
  std::vector<analysis::ShaftTrend> trends;  ///< empty unless they can be compared
};

/// Tables of all shafts, then the verdict.
[[nodiscard]] std::string TrendText(const FollowedSessions& followed);
[[nodiscard]] nlohmann::ordered_json TrendJson(const FollowedSessions& followed);
/// Amplitude over sessions, a panel per shaft, with the height from which on it has risen.
[[nodiscard]] svg::Figure TrendFigure(const FollowedSessions& followed);

}  // namespace levitas::cli
