#pragma once
// Full spectrum of each bearing: the orbit x + jy seen forward and backward.
//
//   R(f) = 1/(N g) sum_n w_n (x_n + j y_n - mean) exp(-j 2 pi f n / N)      Hann window w, g = mean
//   w
//
// so that a circular orbit of radius a shows a line of height a at its signed frequency: positive
// is forward whirl (x to y, as docs/conventions.md), negative backward. After Southwick (1994).
//
// Units    metres (amplitude, not density) over hertz. Thread any; allocates.
// Failure  nothing while fewer than kLength uninterrupted samples are there, or one is no number.

#include <complex>
#include <optional>
#include <vector>

#include "dashboard/sample_store.hpp"

namespace levitas::dashboard {

struct FullSpectrum {
  double line_spacing_hz{};
  double highest_hz{};  ///< lines reach from -highest_hz to +highest_hz
  double time_s{};      ///< of the run, at the end of the samples
  double speed_rad_per_s{};
  std::vector<std::vector<double>> amplitude_m;  ///< per bearing, rising frequency
};

inline constexpr std::size_t kSpectrumLength = 4096;

/// Of the newest samples, up to `highest_hz` (bounded by half the sampling rate).
[[nodiscard]] std::optional<FullSpectrum> SpectrumOf(const SampleStore& store, double highest_hz);

/// Amplitudes of one complex signal of a power of two of samples; index 0 is the lowest frequency.
[[nodiscard]] std::vector<double> FullAmplitudes(std::vector<std::complex<double>> signal,
                                                 std::size_t lines_each_side);

}  // namespace levitas::dashboard
