#include "diagnosis/inference/mode_probe.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/inference/residual.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kReach = 0.15;     // of the mode's frequency
constexpr double kStandsOut = 3.0;  // times the noise
constexpr double kNear = 0.015;     // closer than this derivatives reach

std::vector<Trajectory> Standing(const std::vector<Trajectory>& runs) {
  std::vector<Trajectory> standing;
  for (const Trajectory& run : runs) {
    const bool turns = std::any_of(run.moments.begin(), run.moments.end(),
                                   [](const SamplePoint& m) { return m.speed_rad_per_s != 0.0F; });
    if (!turns) standing.push_back(run);
  }
  return standing.empty() ? runs : standing;
}

/// Power over noise, line by line, of all channels together.
std::vector<double> Ratio(const Residual& residual) {
  std::vector<double> sum(residual.channels.front().ratio.size(), 0.0);
  for (const ChannelResidual& channel : residual.channels) {
    for (std::size_t i = 0; i < std::min(sum.size(), channel.ratio.size()); ++i) {
      sum[i] += channel.ratio[i] / static_cast<double>(residual.channels.size());
    }
  }
  return sum;
}

/// [Hz] of the highest line within reach, between its neighbours; 0 when nothing stands out.
double Peak(const std::vector<double>& ratio, double spacing_hz, double mode_hz) {
  const auto line = [spacing_hz](double hz) {
    return static_cast<std::size_t>(std::max(1.0, std::round(hz / spacing_hz)));
  };
  const std::size_t from = line((1.0 - kReach) * mode_hz);
  const std::size_t to = std::min(line((1.0 + kReach) * mode_hz), ratio.size() - 2);
  if (from >= to) return 0.0;
  const auto highest = std::max_element(ratio.begin() + static_cast<std::ptrdiff_t>(from),
                                        ratio.begin() + static_cast<std::ptrdiff_t>(to));
  if (*highest < kStandsOut) return 0.0;
  const auto at = static_cast<std::size_t>(highest - ratio.begin());
  const double sum = ratio[at - 1] + ratio[at] + ratio[at + 1];
  return spacing_hz * (static_cast<double>(at) + (ratio[at + 1] - ratio[at - 1]) / sum);
}

}  // namespace

std::vector<ModeProbe> ProbeModes(const RigView& rig, const std::vector<Term>& terms,
                                  const std::vector<Hypothesis>& hypotheses,
                                  const std::vector<Trajectory>& runs) {
  std::vector<ModeProbe> probes;
  const Residual residual = AnalyseResidual(rig, Standing(runs));
  if (residual.channels.empty() || residual.channels.front().ratio.size() < 3) return probes;
  const std::vector<double> ratio = Ratio(residual);
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    const Hypothesis& hypothesis = hypotheses[h];
    if (hypothesis.effect != effect::Id::kModalFrequency || hypothesis.terms.size() != 1) continue;
    const std::size_t term = hypothesis.terms.front();
    for (std::size_t mode = 2; mode < rig.modes; ++mode) {
      if (terms[term].location.mode != mode - 1) continue;
      const double mode_hz = rig.omega_rad_per_s[mode] / (2.0 * std::numbers::pi);
      const double peak_hz = Peak(ratio, residual.line_spacing_hz, mode_hz);
      const double theta = peak_hz / mode_hz - 1.0;
      if (peak_hz > 0.0 && std::abs(theta) > kNear) probes.push_back({h, term, theta});
    }
  }
  return probes;
}

}  // namespace levitas::diagnosis
