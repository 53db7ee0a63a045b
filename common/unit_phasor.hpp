#pragma once
// Cosine and sine of an angle that is counted in turns, with the same bits on every machine.
//
// Why        the C library chooses its sine by the processor it finds (with or without fused
//            multiply-add), so that a recorded run would not repeat bit for bit elsewhere.
// Equation   x = 2 pi (t - q/4), q the nearest quarter, |x| <= pi/4; Taylor polynomials of degree
//            17 and 16, whose first term left out is below 3e-17 there.
// Error      below 4e-16 (tests compare with the C library in long double).
// Thread     any; pure, allocates nothing. Failure: what is not finite gives NaN in both.

#include <cmath>
#include <numbers>

namespace levitas {

struct UnitPhasor {
  double cosine{1.0};
  double sine{};
};

/// e^{j 2 pi turns}; accurate while |turns| is small against 1e9.
[[nodiscard]] inline UnitPhasor PhasorOfTurns(double turns) noexcept {
  const double within = turns - std::floor(turns);  // 0 .. 1
  const double quarter = std::floor(4.0 * within + 0.5);
  const double x = 2.0 * std::numbers::pi * (within - 0.25 * quarter);
  const double x2 = x * x;
  double sine = 1.0;
  for (int k = 16; k >= 2; k -= 2) sine = 1.0 - x2 * sine / static_cast<double>(k * (k + 1));
  sine *= x;
  double cosine = 1.0;
  for (int k = 15; k >= 1; k -= 2) cosine = 1.0 - x2 * cosine / static_cast<double>(k * (k + 1));
  if (quarter == 1.0) return {-sine, cosine};
  if (quarter == 2.0) return {-cosine, -sine};
  if (quarter == 3.0) return {sine, -cosine};
  return {cosine, sine};
}

}  // namespace levitas
