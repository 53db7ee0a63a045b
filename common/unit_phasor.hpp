#pragma once
// Cosine and sine of an angle that is counted in turns, with the same bits on every machine.
//
// Why        the C library chooses its sine by the processor it finds (with or without fused
//            multiply-add), so that a recorded run would not repeat bit for bit elsewhere.
// Equation   x = 2 pi (t - q/4), q the nearest quarter, |x| <= pi/4; Taylor polynomials of degree
//            17 and 16, whose first term left out is below 3e-17 there.
// Error      below 4e-16 (tests compare with the C library in long double).
// Thread     any; pure, allocates nothing. Failure: what is not finite gives NaN in both.

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace levitas {

struct UnitPhasor {
  double cosine{1.0};
  double sine{};
};

namespace unit_phasor {

// Of x^0, x^2, ... of cos x, and of sin x / x.
inline constexpr std::array kCosine{1.0,
                                    -1.0 / 2.0,
                                    1.0 / 24.0,
                                    -1.0 / 720.0,
                                    1.0 / 40320.0,
                                    -1.0 / 3628800.0,
                                    1.0 / 479001600.0,
                                    -1.0 / 87178291200.0,
                                    1.0 / 20922789888000.0};
inline constexpr std::array kSine{1.0,
                                  -1.0 / 6.0,
                                  1.0 / 120.0,
                                  -1.0 / 5040.0,
                                  1.0 / 362880.0,
                                  -1.0 / 39916800.0,
                                  1.0 / 6227020800.0,
                                  -1.0 / 1307674368000.0,
                                  1.0 / 355687428096000.0};

}  // namespace unit_phasor

/// e^{j 2 pi turns}; accurate while |turns| is small against 1e9.
[[nodiscard]] inline UnitPhasor PhasorOfTurns(double turns) noexcept {
  const double within = turns - std::floor(turns);  // 0 .. 1
  const double quarter = std::floor(4.0 * within + 0.5);
  const double x = 2.0 * std::numbers::pi * (within - 0.25 * quarter);
  const double x2 = x * x;
  double cosine = unit_phasor::kCosine.back();
  double sine = unit_phasor::kSine.back();
  for (std::size_t k = unit_phasor::kCosine.size() - 1; k-- > 0;) {
    cosine = cosine * x2 + unit_phasor::kCosine[k];
    sine = sine * x2 + unit_phasor::kSine[k];
  }
  sine *= x;
  if (quarter == 1.0) return {-sine, cosine};
  if (quarter == 2.0) return {-cosine, -sine};
  if (quarter == 3.0) return {sine, -cosine};
  return {cosine, sine};
}

}  // namespace levitas
