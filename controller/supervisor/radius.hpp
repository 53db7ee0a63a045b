#pragma once
// Radii in a bearing, as the protections count and report them. Frame: bearing frame; units: SI.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/axes.hpp"
#include "common/frames.hpp"

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

/// Over all bearings of the frame; not a number where one of its positions is none: then nothing is
/// known.
[[nodiscard]] inline double LargestRadius(const SensorFrame& frame) noexcept {
  double square_m2 = 0.0;
  for (std::size_t x = 0; x + 1 < kMaxAxes && x < frame.axes; x += 2) {
    const double here_m2 = frame.position_m[x] * frame.position_m[x] +
                           frame.position_m[x + 1] * frame.position_m[x + 1];
    if (std::isnan(here_m2)) return here_m2;
    square_m2 = std::max(square_m2, here_m2);
  }
  return std::sqrt(square_m2);
}

}  // namespace levitas::supervisor
