#pragma once
// Position sensor of one axis: filter of first or second order, then noise, converter and polarity.
//
// Equation   s' = (g p - s)/tau; over a step the position p runs linearly from start to end, for
//            which the step is exact. docs/derivations.md (20)-(22). A Butterworth filter of second
//            order, s'' + 2 z w s' + w^2 s = w^2 g p with z = 1/sqrt 2, steps as a mode does
//            (plant/mode_step.hpp); its -3 dB are at w.
// Thread     any; pure functions. Not done: run-out; the static curve, see characteristic.hpp.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace levitas::sensor {

inline constexpr double kButterworthDamping = std::numbers::sqrt2 / 2.0;

/// s(h) = decay s(0) + start p(0) + end p(h)
struct FilterStep {
  double decay{};
  double start{};
  double end{};
};

[[nodiscard]] FilterStep MakeFilterStep(double bandwidth_hz, double gain, double duration_s);

struct Converter {
  double noise_rms_m{};
  double step_m{};   ///< 0 = not quantised
  double range_m{};  ///< clips at +- range; 0 = never clips
};

/// What the converter makes of the filtered position; `normal` has unit variance.
[[nodiscard]] inline double Convert(const Converter& c, double filtered_m, double normal) noexcept {
  double value_m = filtered_m + c.noise_rms_m * normal;
  if (c.step_m > 0.0) value_m = std::nearbyint(value_m / c.step_m) * c.step_m;
  if (c.range_m > 0.0) value_m = std::clamp(value_m, -c.range_m, c.range_m);
  return value_m;
}

}  // namespace levitas::sensor
