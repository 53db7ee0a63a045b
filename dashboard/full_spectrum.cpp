#include "dashboard/full_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "analysis/full_spectrum.hpp"

namespace levitas::dashboard {
namespace {

/// The greatest of `group` lines for each, the line at zero in the middle of its own.
std::vector<double> Thinned(const std::vector<double>& lines, std::size_t group) {
  const std::size_t side = lines.size() / 2;
  const std::size_t kept = side / group;
  std::vector<double> thin(2 * kept + 1);
  for (std::size_t line = 0; line <= side; ++line) {
    const std::size_t to = (line + (group - 1) / 2) / group;
    if (to > kept) break;
    thin[kept + to] = std::max(thin[kept + to], lines[side + line]);
    thin[kept - to] = std::max(thin[kept - to], lines[side - line]);
  }
  return thin;
}

}  // namespace

std::optional<FullSpectrum> SpectrumOf(const SampleStore& store, double highest_hz) {
  if (store.contiguous() < kSpectrumLength) return std::nullopt;
  FullSpectrum spectrum;
  const double rate_hz = 1.0 / store.period_s();
  spectrum.line_spacing_hz = rate_hz / static_cast<double>(kSpectrumLength);
  const auto lines = static_cast<std::size_t>(
      std::clamp(highest_hz / spectrum.line_spacing_hz, 1.0, 0.5 * kSpectrumLength - 1.0));
  const std::size_t group = (lines + kMostLines - 1) / kMostLines;
  spectrum.time_s = static_cast<double>(store.newest_cycle()) * store.period_s();
  spectrum.speed_rad_per_s = static_cast<double>(store.Speed(kSpectrumLength / 2));
  for (std::size_t bearing = 0; bearing < store.bearings(); ++bearing) {
    std::vector<std::complex<double>> orbit;
    orbit.reserve(kSpectrumLength);
    for (std::size_t n = 0; n < kSpectrumLength; ++n) {
      const std::size_t back = kSpectrumLength - 1 - n;
      const std::complex<double> r{static_cast<double>(store.Displacement(bearing, 0, back)),
                                   static_cast<double>(store.Displacement(bearing, 1, back))};
      if (!std::isfinite(r.real()) || !std::isfinite(r.imag())) return std::nullopt;
      orbit.push_back(r);
    }
    const auto amplitudes = analysis::FullAmplitudes(std::move(orbit), lines);
    spectrum.amplitude_m.push_back(group > 1 ? Thinned(amplitudes, group) : amplitudes);
  }
  spectrum.line_spacing_hz *= static_cast<double>(group);
  spectrum.highest_hz = static_cast<double>(lines / group) * spectrum.line_spacing_hz;
  return spectrum;
}

}  // namespace levitas::dashboard
