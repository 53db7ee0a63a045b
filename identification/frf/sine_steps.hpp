#pragma once
// Sines that follow one another, read off the excitation itself: a stepped sine need not repeat.
//
// Equation  within a step x[n+k] + x[n-k] = 2 cos(2 pi f k) x[n]; k about a quarter of the period,
//           where the right side tells f best. A step ends where this fails by 1e-3 of the largest
//           value; its frequency is then fitted to all its samples.
// Units     f [1/sample].
// Limits    a step of fewer than one and a half periods is not seen as one; neighbours closer than
//           about 0.5 % run into each other.
// Thread    any.

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace levitas::identification {

struct SineStep {
  std::size_t begin{}, end{};  ///< samples, within the signal
  double cycles_per_sample{};
  std::complex<double> amplitude;  ///< c of Re c exp(2 pi j f (n - begin))
};

/// Empty when any part of the signal is no sine. The signal neither begins nor ends with zeros.
[[nodiscard]] std::vector<SineStep> FindSineSteps(std::span<const double> signal);

/// Mean and complex amplitude of the sine of known frequency in `signal`, by least squares; phase
/// counts from sample `offset` before the first.
[[nodiscard]] std::complex<double> SineAmplitude(std::span<const double> signal,
                                                 double cycles_per_sample, std::size_t offset);

}  // namespace levitas::identification
