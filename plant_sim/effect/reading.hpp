#pragma once
// What a sensor reads that is not the displacement: characteristic, run-out, pickup, coloured
// noise.
//
// Equation   y + a2 y^2 + a3 y^3;   run-out  A cos(n (angle - probe) + phase), probe angle 0 for x
//            and 90 degrees for y: the surface turns past probes that stand still.
// Thread     any; pure, no allocation.

#include <cmath>
#include <complex>
#include <numbers>

namespace levitas::effect {

[[nodiscard]] inline double Characteristic(double y_m, double a2_1_per_m,
                                           double a3_1_per_m2) noexcept {
  return y_m + y_m * y_m * (a2_1_per_m + a3_1_per_m2 * y_m);
}

/// e^(j n angle) from the rotor's direction (cos, sin), without trigonometry: n multiplications.
[[nodiscard]] inline std::complex<double> Turned(double cosine, double sine, int order) noexcept {
  const double s = order < 0 ? -sine : sine;
  double real = 1.0;
  double imaginary = 0.0;
  for (int k = std::abs(order); k > 0; --k) {
    const double next = real * cosine - imaginary * s;
    imaginary = real * s + imaginary * cosine;
    real = next;
  }
  return {real, imaginary};
}

/// A e^(j(phase - order probe)): the run-out a probe reads is Re(this x e^(j order angle)).
[[nodiscard]] inline std::complex<double> RunoutAmplitude(double amplitude_m, double phase_rad,
                                                          int order, bool y_probe) noexcept {
  const double probe_rad = y_probe ? 0.5 * std::numbers::pi : 0.0;
  return std::polar(amplitude_m, phase_rad - order * probe_rad);
}

/// Factor a of n' = a n + sqrt(1 - a^2) w, so that the noise keeps its power; 0 is white.
[[nodiscard]] inline double NoiseMemory(double corner_hz, double period_s) noexcept {
  return corner_hz > 0.0 ? std::exp(-2.0 * std::numbers::pi * corner_hz * period_s) : 0.0;
}

}  // namespace levitas::effect
