#pragma once
// The search's own reading of a loop held against that of analysis, which shares no line with it.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "analysis/sensitivity.hpp"
#include "design/pid/loop_survey.hpp"

namespace levitas::design {

/// Both say that the loop is stable, or both that it is not; of a stable one the peaks agree.
/// Returns whether it is stable.
inline bool ExpectAsAnalysisSays(const LoopSurvey& survey, const analysis::SensitivityResult& exact,
                                 const std::string& which) {
  EXPECT_EQ(survey.growing <= 0, exact.largest_pole_modulus < 1.0) << which;
  if (!exact.stable) return false;
  double peak = 0.0;
  for (const auto& axis : exact.axes) peak = std::max(peak, axis.peak);
  // A parabola through three of forty points a decade.
  EXPECT_NEAR(survey.sensitivity.value, peak, 0.02 * peak) << which;
  // No parabola: the grid's own step.
  EXPECT_NEAR(survey.singular.value, exact.largest_singular_value,
              0.05 * exact.largest_singular_value)
      << which;
  return true;
}

}  // namespace levitas::design
