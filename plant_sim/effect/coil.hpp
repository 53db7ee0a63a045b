#pragma once
// What the coils of one axis do that the nominal magnet does not: gain, asymmetry, saturation.
//
// Equation   gain        i+- = b +- c -> b +- ratio c: the control part counts ratio times. The
//                        limits of a coil are those of the current it carries, hence of i+-.
//            saturation  i -> i/(1 + (i/knee)^n)^(1/n)
//            asymmetry   k+ = k (1 + a), k- = k (1 - a), a = (ratio - 1)/(ratio + 1), expressed as
//                        factors sqrt(1 +- a) on the coil currents
// Source     Schweitzer & Maslen (2009), Magnetic Bearings, ch. 3-4; n = 1 is Froelich's law.
// Thread     any; pure.

#include <cmath>

namespace levitas::effect {

/// Currents of the two coils of an axis [A].
struct CoilPair {
  double towards{};
  double away{};
};

/// What acts in the place of the currents carried. One of the two may come out below zero: its
/// force is that of the square, so that at x = 0 the force is exactly `gain` times the nominal one.
[[nodiscard]] inline CoilPair Scaled(const CoilPair& carried, double gain) noexcept {
  if (gain == 1.0) return carried;
  const double bias_a = 0.5 * (carried.towards + carried.away);
  const double control_a = 0.5 * gain * (carried.towards - carried.away);
  return {bias_a + control_a, bias_a - control_a};
}

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
