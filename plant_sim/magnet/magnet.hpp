#pragma once
// Radial magnet in differential driving: two opposed coils, true force and its linear form.
//
// Equation   F = k [ (i+/(s0-x))^2 - (i-/(s0+x))^2 ],  i+- = i0 +- ic    (14)
//            ki = 4 k i0/s0^2,  ks = 4 k i0^2/s0^3 (positive: destabilising)    (15)
//            numbered as in docs/derivations.md
//            or, of a magnet over a long stroke, F = f0 [ i+^2 e^(-(s0-x)/d) - i-^2 e^(-(far+x)/d)
//            ]
// Source     Schweitzer & Maslen (2009), Magnetic Bearings, ch. 3-4; the exponential law is what
//            INTECO gives for its levitator MLS2EM.
// Frame      bearing frame: x towards the coil that carries i+.
// Thread     any; pure functions. Not done: eddy currents, hysteresis, saturation of the iron.

#include <algorithm>
#include <cmath>

namespace levitas::magnet {

struct Magnet {
  double force_constant_n_m2_per_a2{};  ///< k
  double gap_m{};                       ///< s0
  double max_coil_current_a{};
  double decay_m{};         ///< d of the exponential law; 0: the law of the gap squared
  double force_n_per_a2{};  ///< f0 of the exponential law
  double far_gap_m{};       ///< gap of the coil away from +x at x = 0, exponential law
};

/// Force per square of the current in either coil [N/A^2] under the exponential law.
[[nodiscard]] inline double TowardsPerSquare(const Magnet& m, double x_m) noexcept {
  return m.force_n_per_a2 * std::exp((x_m - m.gap_m) / m.decay_m);
}
[[nodiscard]] inline double AwayPerSquare(const Magnet& m, double x_m) noexcept {
  return m.force_n_per_a2 * std::exp(-(m.far_gap_m + x_m) / m.decay_m);
}

/// Force [N] of two coil currents.
[[nodiscard]] inline double ForceOfCoils(const Magnet& m, double towards_a, double away_a,
                                         double x_m) noexcept {
  if (m.decay_m > 0.0) {
    return TowardsPerSquare(m, x_m) * towards_a * towards_a -
           AwayPerSquare(m, x_m) * away_a * away_a;
  }
  // On one fraction, so that the two quotients cost one division.
  const double near = m.gap_m - x_m;
  const double far = m.gap_m + x_m;
  const double a = towards_a * far;
  const double b = away_a * near;
  const double gaps = near * far;
  return m.force_constant_n_m2_per_a2 * (a + b) * (a - b) / (gaps * gaps);
}

/// Force [N]. A coil cannot carry less than nothing or more than its maximum: both are clamped.
[[nodiscard]] inline double Force(const Magnet& m, double bias_a, double control_a,
                                  double x_m) noexcept {
  const double towards = std::clamp(bias_a + control_a, 0.0, m.max_coil_current_a);
  const double away = std::clamp(bias_a - control_a, 0.0, m.max_coil_current_a);
  return ForceOfCoils(m, towards, away, x_m);
}

[[nodiscard]] inline double ForcePerCurrent(const Magnet& m, double bias_a) noexcept {
  if (m.decay_m > 0.0) return 2.0 * bias_a * (TowardsPerSquare(m, 0.0) + AwayPerSquare(m, 0.0));
  return 4.0 * m.force_constant_n_m2_per_a2 * bias_a / (m.gap_m * m.gap_m);
}

[[nodiscard]] inline double NegativeStiffness(const Magnet& m, double bias_a) noexcept {
  if (m.decay_m > 0.0) {
    return bias_a * bias_a * (TowardsPerSquare(m, 0.0) + AwayPerSquare(m, 0.0)) / m.decay_m;
  }
  return 4.0 * m.force_constant_n_m2_per_a2 * bias_a * bias_a / (m.gap_m * m.gap_m * m.gap_m);
}

/// Of a horseshoe magnet whose poles stand at an angle to its axis: along the axis the gap closes
/// by the cosine only, which is law (14) with a constant and a gap of their own.           (16),
/// (16a)
struct AxisLaw {
  double force_constant_n_m2_per_a2{};  ///< mu0 N^2 A / (4 cos(half pole angle))
  double gap_m{};                       ///< gap at the pole / cos(half pole angle)
};
[[nodiscard]] AxisLaw LawOfPoles(double turns, double pole_area_m2, double half_pole_angle_rad,
                                 double pole_gap_m);

}  // namespace levitas::magnet
