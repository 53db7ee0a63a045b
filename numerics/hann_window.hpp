#pragma once
// Hann's window, periodic: the one for spectra (Harris 1978, Proc. IEEE 66, 51).
//
// Equation  w_n = 1/2 - 1/2 cos(2 pi n / N): mean 1/2, mean square 3/8; two of them, N/2 apart,
//           add up to 1.
// Thread    any; pure. Failure: none.

#include <cmath>
#include <cstddef>
#include <numbers>

namespace levitas::numerics {

[[nodiscard]] inline double HannWeight(std::size_t n, std::size_t length) noexcept {
  const double phase = 2.0 * std::numbers::pi * static_cast<double>(n);
  return 0.5 - 0.5 * std::cos(phase / static_cast<double>(length));
}

}  // namespace levitas::numerics
