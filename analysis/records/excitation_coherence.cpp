#include "analysis/records/excitation_coherence.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/records/spectrum.hpp"

namespace levitas::analysis {
namespace {

/// Lines 10 Hz apart at 10 kHz, and fifty averages in two and a half seconds.
constexpr std::size_t kSegment = 1024;
/// Neighbouring lines of a Hann window are not independent: the variance of a mean over many lines
/// is this much larger (1 + 2 (2/3)^2 + 2 (1/6)^2).
constexpr double kLineVariance = 1.94;

struct LineSums {
  std::vector<double> coherence;  ///< sum over the test signals
  std::vector<double> density;
  double chance{};
  double spacing_hz{};
  std::size_t signals{};
};

LineSums Sum(const InnovationRun& run, std::size_t channel, std::size_t axes) {
  LineSums sums;
  Welch welch(kSegment, 1.0 / run.period_s);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    Coherence coherence(kSegment);
    bool excited = false;
    for (const auto& piece : run.pieces) {
      std::vector<double> innovation, excitation;
      for (const auto& row : piece) {
        innovation.push_back(row.innovation_m[channel]);
        excitation.push_back(row.excitation_a[axis]);
        excited = excited || row.excitation_a[axis] != 0.0;
      }
      coherence.Add(innovation, excitation);
      if (axis == 0) welch.Add(innovation);
    }
    if (!excited) continue;
    const auto squared = coherence.Squared();
    sums.coherence.resize(squared.size(), 0.0);
    for (std::size_t line = 0; line < squared.size(); ++line) sums.coherence[line] += squared[line];
    sums.chance = coherence.Chance();
    ++sums.signals;
  }
  sums.density = welch.Density();
  sums.spacing_hz = welch.line_spacing_hz();
  return sums;
}

}  // namespace

std::vector<ExcitationReport> FollowExcitation(const InnovationRun& run, std::size_t channel,
                                               std::size_t axes, std::span<const double> edges_hz) {
  const LineSums sums = Sum(run, channel, axes);
  std::vector<ExcitationReport> reports;
  // Too few averages tell nothing from chance.
  if (sums.signals == 0 || sums.chance > 0.2) return reports;
  double whole_m2 = 0.0;
  for (const double density : sums.density) whole_m2 += density * sums.spacing_hz;
  const auto signals = static_cast<double>(sums.signals);
  for (std::size_t band = 0; band + 1 < edges_hz.size(); ++band) {
    double coherence = 0.0;
    double following_m2 = 0.0;
    double lines = 0.0;
    for (std::size_t line = 1; line < sums.coherence.size(); ++line) {
      const double f = static_cast<double>(line) * sums.spacing_hz;
      if (f < edges_hz[band] || f >= edges_hz[band + 1]) continue;
      const double beyond = sums.coherence[line] - signals * sums.chance;
      coherence += sums.coherence[line];
      following_m2 += beyond * sums.density[line] * sums.spacing_hz;
      lines += 1.0;
    }
    if (lines == 0.0) continue;
    const double ratio = coherence / (lines * signals * sums.chance);
    // Squared coherence of unrelated signals is spread exponentially: deviation equals mean.
    reports.push_back({edges_hz[band], std::min(edges_hz[band + 1], 0.5 / run.period_s), ratio,
                       (ratio - 1.0) * std::sqrt(lines * signals / kLineVariance),
                       std::max(0.0, following_m2) / whole_m2});
  }
  return reports;
}

}  // namespace levitas::analysis
