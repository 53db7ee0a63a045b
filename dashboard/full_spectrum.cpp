#include "dashboard/full_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/spectrum.hpp"

namespace levitas::dashboard {

std::vector<double> FullAmplitudes(std::vector<std::complex<double>> signal,
                                   std::size_t lines_each_side) {
  const std::size_t size = signal.size();
  std::complex<double> mean{};
  for (const auto& value : signal) mean += value;
  mean /= static_cast<double>(size);
  for (std::size_t n = 0; n < size; ++n) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(n);
    signal[n] = (signal[n] - mean) * (0.5 - 0.5 * std::cos(phase / static_cast<double>(size)));
  }
  analysis::FourierTransform(signal);
  // The Hann window's mean is one half: a line keeps its height.
  const double scale = 2.0 / static_cast<double>(size);
  const std::size_t lines = std::min(lines_each_side, size / 2 - 1);
  std::vector<double> amplitude;
  amplitude.reserve(2 * lines + 1);
  for (std::size_t k = size - lines; k < size; ++k)
    amplitude.push_back(scale * std::abs(signal[k]));
  for (std::size_t k = 0; k <= lines; ++k) amplitude.push_back(scale * std::abs(signal[k]));
  return amplitude;
}

std::optional<FullSpectrum> SpectrumOf(const SampleStore& store, double highest_hz) {
  if (store.contiguous() < kSpectrumLength) return std::nullopt;
  FullSpectrum spectrum;
  const double rate_hz = 1.0 / store.period_s();
  spectrum.line_spacing_hz = rate_hz / static_cast<double>(kSpectrumLength);
  const auto lines = static_cast<std::size_t>(
      std::clamp(highest_hz / spectrum.line_spacing_hz, 1.0, 0.5 * kSpectrumLength - 1.0));
  spectrum.highest_hz = static_cast<double>(lines) * spectrum.line_spacing_hz;
  spectrum.time_s = static_cast<double>(store.newest_cycle()) * store.period_s();
  spectrum.speed_rad_per_s = static_cast<double>(store.Speed(kSpectrumLength / 2));
  for (std::size_t bearing = 0; bearing < store.axes() / 2; ++bearing) {
    std::vector<std::complex<double>> orbit;
    orbit.reserve(kSpectrumLength);
    for (std::size_t n = 0; n < kSpectrumLength; ++n) {
      const std::size_t back = kSpectrumLength - 1 - n;
      const std::complex<double> r{static_cast<double>(store.Position(2 * bearing, back)),
                                   static_cast<double>(store.Position(2 * bearing + 1, back))};
      if (!std::isfinite(r.real()) || !std::isfinite(r.imag())) return std::nullopt;
      orbit.push_back(r);
    }
    spectrum.amplitude_m.push_back(FullAmplitudes(std::move(orbit), lines));
  }
  return spectrum;
}

}  // namespace levitas::dashboard
