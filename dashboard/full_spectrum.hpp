#pragma once
// Full spectrum of each bearing (analysis/full_spectrum.hpp) of the newest samples.
//
// Lines    at most kMostLines a side: beyond that the greatest of neighbours stands for them, so
//          that no peak is lost and a wide spectrum is no longer than a narrow one.
// Units    metres (amplitude, not density) over hertz. Thread any; allocates.
// Failure  nothing while fewer than kLength uninterrupted samples are there, or one is no number.

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
inline constexpr std::size_t kMostLines = 210;  ///< a side; 512 Hz at 10 kHz without thinning

/// Of the newest samples, up to `highest_hz` (bounded by half the sampling rate).
[[nodiscard]] std::optional<FullSpectrum> SpectrumOf(const SampleStore& store, double highest_hz);

}  // namespace levitas::dashboard
