#pragma once
// Transverse crack: how compliant it makes the shaft, and how it opens and closes.
//
// Equation   extra rotation per bending moment  c = 6 pi (1 - nu^2) d P(depth)/(E I), with the
//            polynomial P of Chondros, Dimarogonas & Yao (1998), J. Sound Vib. 215(1) 17,
//            (one-sided edge crack; the height of the section taken as the diameter); breathing
//            under its weight  g = (1 + cos(angle + phase - gravity))/2, after Gasch (1993), J.
//            Sound Vib. 160(2) 313: open (g = 1) when the crack points along gravity.
// In modes   the hinge turns by phi, of which the moment E I k (k = sum of k_i q_i) loses
//            (E I)^2 R phi, R = sum of k_i^2/w_i^2 over the modes of the model (unit modal masses).
//            With phi = c M a softening S g/(1 + S g R) is left, S = c (E I)^2
//            (docs/derivations.md): frequencies hardly depend on the number of modes. S g alone,
//            of first order in c, takes away the more the more modes there are, and of a thick
//            shaft with a deep crack and many modes all.
// Thread     any; pure.

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace levitas::effect {

/// c E I/d, dimensionless; `depth` is the share of the diameter, 0 to 0.5.
[[nodiscard]] inline double CrackCompliance(double depth, double poisson) noexcept {
  constexpr std::array<double, 9> kCoefficients{0.6272,   -1.04533, 4.5948,   -9.9736, 20.2948,
                                                -33.0351, 47.1063,  -40.7556, 19.6};
  double sum = 0.0;
  for (std::size_t k = kCoefficients.size(); k-- > 0;) sum = sum * depth + kCoefficients[k];
  return 6.0 * std::numbers::pi * (1.0 - poisson * poisson) * sum * depth * depth;
}

/// Share of the crack that is open; (cosine, sine) is its direction now.
[[nodiscard]] inline double Opening(double cosine, double sine, double gravity_direction_x,
                                    double gravity_direction_y) noexcept {
  return 0.5 * (1.0 + cosine * gravity_direction_x + sine * gravity_direction_y);
}

/// [1/(N m^3)] R: of every mode the curvature and the frequency [rad/s]; rigid modes have none.
[[nodiscard]] inline double CurvatureCompliance(
    const std::vector<double>& curvature, const std::vector<double>& frequency_rad_per_s) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < curvature.size(); ++i) {
    const double w = frequency_rad_per_s[i];
    if (w > 0.0) sum += curvature[i] * curvature[i] / (w * w);
  }
  return sum;
}

/// [N m^3] What a hinge of S = `hinge_n_m3`, open by a share, takes away; `residual_per_n_m3` is R.
[[nodiscard]] inline double CrackSoftening(double hinge_n_m3, double open,
                                           double residual_per_n_m3) noexcept {
  const double opened = hinge_n_m3 * open;
  return opened / (1.0 + opened * residual_per_n_m3);
}

}  // namespace levitas::effect
