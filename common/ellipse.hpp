#pragma once
// The ellipse that a bearing's centre of the shaft runs through at one frequency.
//
// Equation  x = Re(X e^{jwt}), y = Re(Y e^{jwt}): a forward circle of |X + jY|/2 and a backward one
//           of |X - jY|/2, whose sum is the largest radius.
// Units     those of X and Y. Thread: any; pure. Failure: none.

#include <complex>

namespace levitas {

[[nodiscard]] inline double LargestRadius(std::complex<double> x, std::complex<double> y) {
  const std::complex<double> j(0.0, 1.0);
  return 0.5 * (std::abs(x + j * y) + std::abs(x - j * y));
}

}  // namespace levitas
