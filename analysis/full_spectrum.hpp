#pragma once
// Full spectrum of one orbit r = x + jy: forward whirl on the right, backward on the left.
//
//   R(f) = 1/(N g) sum_n w_n (r_n - mean) exp(-j 2 pi f n / N)      Hann window w, g = mean of w
//
// so that a circular orbit of radius a shows a line of height a at its signed frequency: positive
// is forward whirl (x to y, as docs/conventions.md), negative backward. After Southwick (1994).
//
// Units    those of the orbit (amplitude, not density). Thread any; allocates.
// Length   at least two samples; fast for products of small primes (fourier_transform.hpp).
// Failure  none.

#include <complex>
#include <cstddef>
#include <vector>

namespace levitas::analysis {

/// Amplitudes from -lines to +lines times the line spacing (sampling rate over length).
[[nodiscard]] std::vector<double> FullAmplitudes(std::vector<std::complex<double>> orbit,
                                                 std::size_t lines_each_side);

}  // namespace levitas::analysis
