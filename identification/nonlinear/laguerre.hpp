#pragma once
// A bank of discrete Laguerre filters: the past of a signal in a few numbers that stay independent
// of one another however fast one samples.
//
// Equation  L_1 = g/(z - a), L_{i+1} = L_i (1 - a z)/(z - a), g = sqrt(1 - a^2): orthonormal,
//           strictly proper (Wahlberg 1991, IEEE Trans. Automatic Control 36(5) 551). a = 0 gives
//           the plain lags z^-1, z^-2, ... of the polynomial forms.
// Choice    a = exp(-2 pi f T) with f about the bandwidth of what is identified.
// Thread    that of its owner; Push allocates nothing.

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace levitas::identification {

[[nodiscard]] inline double LaguerrePole(double bandwidth_hz, double period_s) {
  return bandwidth_hz > 0.0 ? std::exp(-2.0 * std::numbers::pi * bandwidth_hz * period_s) : 0.0;
}

/// Moves one bank (its entries in a row of a larger vector) by one sample of its input.
inline void PushLaguerre(double pole, double input, Eigen::Ref<Eigen::VectorXd> bank) noexcept {
  const double gain = std::sqrt(1.0 - pole * pole);
  // Section i: x+ = a x + in, out = x for the first, (1 - a^2) x - a in for those that follow; the
  // states kept are the outputs of sections, each fed by the output before it at the same instant.
  double in_now = 0.0;   // output of the section before, this sample
  double in_next = 0.0;  // and the next one
  for (Eigen::Index i = 0; i < bank.size(); ++i) {
    const double now = bank[i];
    // L_{i+1} (z - a) = L_i (1 - a z): next = a now + in_now - a in_next.
    bank[i] = i == 0 ? pole * now + gain * input : pole * now + in_now - pole * in_next;
    in_now = now;
    in_next = bank[i];
  }
}

}  // namespace levitas::identification
