#pragma once
// Picture of the levitated rotor: poles of the sampled loop at the speeds asked for, in the s plane
// and as damping over frequency; frequencies and damping of the modes over speed with the critical
// speeds.
//
// Marks    forward whirl full triangles up, backward hollow ones down, neither a ring. At rest no
//          direction is the forward one: rings.
// Drawn    poles up to a frequency; in the s plane not those far to the left, which decay at once.
// Thread   any; pure.

#include <string>
#include <vector>

#include "analysis/critical_speeds.hpp"
#include "analysis/poles.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report {

struct PolesLook {
  std::string title;
  double up_to_hz{};
  double rated_rad_per_s{};
};

[[nodiscard]] svg::Figure PolesPicture(const std::vector<analysis::LoopPoles>& loops,
                                       const analysis::Campbell& levitated, const PolesLook& look);

/// The frequencies over speed alone: from 0 to what matters for the critical speeds.
[[nodiscard]] svg::Panel LevitatedPanel(const analysis::Campbell& levitated,
                                        double rated_rad_per_s);

}  // namespace levitas::report
