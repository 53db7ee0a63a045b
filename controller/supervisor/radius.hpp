#pragma once
// Radii in a bearing, as the protections count and report them. Frame: bearing frame; units: SI.

#include <cmath>
#include <cstddef>

#include "common/axes.hpp"

namespace levitas::supervisor {

[[nodiscard]] inline double Radius(const AxisArray& position_m, std::size_t bearing) noexcept {
  const double x_m = position_m[2 * bearing];
  const double y_m = position_m[2 * bearing + 1];
  return std::sqrt(x_m * x_m + y_m * y_m);
}

[[nodiscard]] inline AxisArray Deviation(const AxisArray& position_m,
                                         const AxisArray& reference_m) noexcept {
  AxisArray deviation_m = position_m;
  for (std::size_t i = 0; i < kMaxAxes; ++i) deviation_m[i] -= reference_m[i];
  return deviation_m;
}

}  // namespace levitas::supervisor
