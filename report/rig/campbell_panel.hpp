#pragma once
// Campbell diagram as one panel: natural frequencies over speed, the orders that excite
// them, where they cross, rated speed.
//
// Whirl    forward: solid line, full triangles up; backward: dashed, hollow triangles down; torsion
//          and motion in one plane: dotted. No meaning rests on a colour alone.
// Crossing a ring with its speed in rpm and F, B, T or P, at the nearest place where the text
//          covers no line, mark or other text; forward whirl first. One without such a place stays
//          without text: the command's table has them all.
// Thread   any; pure.

#include "analysis/critical_speeds.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report {

struct CampbellLook {
  std::string title;
  double rated_rad_per_s{};
  double top_hz{};                 ///< of the frequency axis
  std::vector<svg::Note> notes{};  ///< of the caller; the texts of crossings keep away from them
};

[[nodiscard]] svg::Panel CampbellPanel(const analysis::Campbell& campbell,
                                       const CampbellLook& look);
/// Damping ratio of the same modes over speed; logarithmic unless something grows.
[[nodiscard]] svg::Panel DampingPanel(const analysis::Campbell& campbell, const CampbellLook& look);

/// How far beyond the rated speed a Campbell diagram goes.
inline constexpr double kBeyondRated = 1.25;

}  // namespace levitas::report
