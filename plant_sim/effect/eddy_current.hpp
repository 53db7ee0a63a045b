#pragma once
// Eddy currents: the flux of a solid or thick-laminated core lags the current by diffusion.
//
// Equation   F = (ki ic + ks x)/(1 + sqrt(s tau)) about the bias: current and displacement make the
//            flux as one, so both lag. A lag of the negative stiffness works as damping. A magnet
//            whose current alone is delayed lags a share of 0 of ks x.
//            The transfer function is a Stieltjes function,
//              1/(1 + sqrt p) = (1/pi) integral over x > 0 of sqrt(x)/((1 + x)(x + p)) dx,
//            so the trapezoid rule in ln x turns it into parallel first-order lags with positive
//            gains: passive, monotone, and smooth in tau. docs/effects.md.
// Accuracy   0.6 % for 2 pi f tau up to 10 (5 % at 100); static gain exact.
// Source     Zhu, Knospe & Maslen (2005), IEEE Trans. Magnetics 41(4) 1248.
// States     kEddyLags per axis [A]: ic + (ks/ki) x after each lag.
// Thread     any; pure. Not done: lag of the bias, and of the force's products of current and
//            displacement.

#include <array>
#include <cstddef>

namespace levitas::effect {

inline constexpr std::size_t kEddyLags = 10;

struct EddyLags {
  std::array<double, kEddyLags> rate{};  ///< tau times the corner [rad/s] of each lag
  std::array<double, kEddyLags> gain{};  ///< static share of each lag
  double direct{};                       ///< what is too fast to be seen
};

/// The same for every tau.
[[nodiscard]] const EddyLags& Eddy() noexcept;

/// The current that makes flux, from the current in the coil and the lags' states.
[[nodiscard]] inline double EddyOutput(double current_a, const double* state_a) noexcept {
  const EddyLags& eddy = Eddy();
  double sum_a = eddy.direct * current_a;
  for (std::size_t k = 0; k < kEddyLags; ++k) sum_a += eddy.gain[k] * state_a[k];
  return sum_a;
}

}  // namespace levitas::effect
