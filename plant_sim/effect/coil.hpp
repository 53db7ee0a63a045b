#pragma once
// What the coils of one axis do that the nominal magnet does not: gain, asymmetry, saturation.
//
// Equation   saturation  i -> i/(1 + (i/knee)^n)^(1/n)
//            asymmetry   k+ = k (1 + a), k- = k (1 - a), a = (ratio - 1)/(ratio + 1), expressed as
//                        factors sqrt(1 +- a) on the coil currents
// Source     Schweitzer & Maslen (2009), Magnetic Bearings, ch. 3-4; n = 1 is Froelich's law.
// Thread     any; pure.

#include <cmath>

namespace levitas::effect {

struct CoilFactors {
  double towards{1.0};
  double away{1.0};
};

/// Current factors of two coils whose force constants have this ratio, their sum unchanged.
[[nodiscard]] inline CoilFactors Asymmetry(double ratio) noexcept {
  const double a = (ratio - 1.0) / (ratio + 1.0);
  return {std::sqrt(1.0 + a), std::sqrt(1.0 - a)};
}

/// Current that gives the same flux without saturation; `current_a` >= 0, `per_knee` = 1/knee.
[[nodiscard]] inline double Saturated(double current_a, double per_knee, double exponent) noexcept {
  if (per_knee == 0.0) return current_a;
  return current_a * std::pow(1.0 + std::pow(current_a * per_knee, exponent), -1.0 / exponent);
}

/// d Saturated / d current.
[[nodiscard]] inline double SaturatedSlope(double current_a, double per_knee,
                                           double exponent) noexcept {
  if (per_knee == 0.0) return 1.0;
  return std::pow(1.0 + std::pow(current_a * per_knee, exponent), -1.0 / exponent - 1.0);
}

}  // namespace levitas::effect
