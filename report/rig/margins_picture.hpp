#pragma once
// Picture of the sensitivity of a loop: per speed |S| over frequency with the zones of ISO 14839-3,
// and the loop of each axis about -1 (Nyquist), the others closed.
//
// Zones    A below 3, B below 4, C below 5, D from there on; about -1 circles of radius 1/3, 1/4
//          and 1/5, which L = 1/S - 1 stays out of.
// Marks    a dot at the peak of every axis in both panels; figures at the worst. In the Nyquist
//          panel rings where that axis has its peak of |S|, its phase margin (|L| = 1) and its gain
//          margins, with their frequencies in a column of texts that lines lead from.
// Axes     told apart by dashes too. Positive frequencies alone.
// Thread   any; pure.

#include <string>
#include <vector>

#include "analysis/sensitivity.hpp"
#include "analysis/sensitivity_curves.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report {

/// What one row of the picture shows.
struct LoopAtSpeed {
  analysis::SensitivityResult peaks;
  analysis::SensitivityCurves curves;
};

[[nodiscard]] svg::Panel SensitivityPanel(const LoopAtSpeed& loop,
                                          const std::vector<std::string>& channels);
[[nodiscard]] svg::Panel NyquistPanel(const LoopAtSpeed& loop,
                                      const std::vector<std::string>& channels);

/// `title` names rig and controller.
[[nodiscard]] svg::Figure MarginsPicture(const std::string& title,
                                         const std::vector<LoopAtSpeed>& loops,
                                         const std::vector<std::string>& channels);

}  // namespace levitas::report
