#pragma once
// The gains of a decentralised PID with filters, by search against named requirements.
//
// Method     a hundred plain PIDs on a grid of stiffness and damping; from the best two,
//            numerics/minimum/evolution_strategy.hpp twice side by side, in rounds. After each
//            round the best law meets every speed of the range and drawn corners of the
//            uncertainty; those that are worst by one of its figures are held from then on.
// Cost       PidFigures::margin; five times what every ratio is above 1; a tenth of the mean of
//            all. Unstable loops by their growing poles. So: the largest margin within the limits.
// Same seed  same law, however many processors. Interrupted: the best so far.
// Failure    Problem when the rig cannot be modelled or its magnets cannot carry it; a law that
//            does not meet the limits is a result.
// Thread     that of the caller, and two of its own.

#include <functional>

#include "design/drawn_rigs/rig_uncertainty.hpp"
#include "design/pid/law_shape.hpp"
#include "design/pid/requirements.hpp"

namespace levitas::design {

struct PidSearchOptions {
  std::size_t evaluations{6000};  ///< of both searches together
  std::size_t corners{8};
  std::size_t lead_lags{1};
  std::size_t notches{2};
  std::vector<double> lead_lags_at_hz, notches_at_hz;  ///< see LawShape
  bool own_filters{true};
  /// As if nothing were known but ki, ks, mass, inertia, delay: one speed, no flexible mode, and
  /// Limit::kAnyMode should be asked.
  bool first_levitation{};
  std::uint64_t seed{1};
  /// Of the PIDs; empty: axis by axis. The law found then has one entry per channel.
  Coordinates coordinates{};
  double third_n{};
  double current_limit_a{};
  /// The range to be held; most 0: 1.1 times the rated speed.
  double least_speed_rad_per_s{}, most_speed_rad_per_s{};
};

/// A law as a search moves it.
struct PidPoint {
  LawShape shape;
  Eigen::VectorXd x;
};

struct PidSearchResult {
  law::LawConfig law;
  PidPoint point;      ///< the same law, for a search that goes on from it
  PidFigures figures;  ///< over every speed and corner
  double cost{};
  std::size_t evaluations{};
  std::size_t plants_met{}, plants_held{};
  bool interrupted{};
};

/// `seen(share done, text)`: false ends the search with the best so far.
[[nodiscard]] PidSearchResult SearchPid(
    const configuration::RigFile& rig, const PidLimits& limits,
    const std::vector<uncertainty::Parameter>& parameters, const PidSearchOptions& options,
    const std::function<bool(double, const std::string&)>& seen);

/// The same from a law that is near already, with its filters: no grid, small steps.
[[nodiscard]] PidSearchResult SearchPidFrom(
    const PidPoint& start, const configuration::RigFile& rig, const PidLimits& limits,
    const std::vector<uncertainty::Parameter>& parameters, const PidSearchOptions& options,
    const std::function<bool(double, const std::string&)>& seen);

[[nodiscard]] double CostOf(const PidFigures& figures);

}  // namespace levitas::design
