#include "design/pid/gain_map.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>

namespace levitas::design {
namespace {

double PeakWith(const law::LawConfig& law, double proportional, double derivative,
                const std::vector<std::shared_ptr<const SampledPlant>>& plants) {
  std::vector<law::DiscreteLaw> laws;
  for (law::AxisLawConfig axis : law.axes) {
    axis.kp_a_per_m *= proportional;
    axis.ki_a_per_m_s *= proportional;
    axis.kd_a_s_per_m *= derivative;
    laws.push_back(law::Discretise(axis, law.period_s));
  }
  const std::vector<double> no_noise(laws.size());
  double peak = 0.0;
  for (const auto& plant : plants) {
    const LoopSurvey survey = Survey(*plant, laws, no_noise);
    if (survey.growing > 0) return std::numeric_limits<double>::infinity();
    peak = std::max(peak, survey.sensitivity.value);
  }
  return peak;
}

}  // namespace

GainMap MapGains(const law::LawConfig& law,
                 const std::vector<std::shared_ptr<const SampledPlant>>& plants,
                 const GainMapOptions& options) {
  GainMap out;
  const std::size_t n = std::max<std::size_t>(options.points, 2);
  for (std::size_t i = 0; i < n; ++i)
    out.factors.push_back(options.least *
                          std::pow(options.most / options.least,
                                   static_cast<double>(i) / static_cast<double>(n - 1)));
  out.peak.resize(n * n);
  const auto rows = [&](std::size_t first) {
    for (std::size_t d = first; d < n; d += 2)
      for (std::size_t p = 0; p < n; ++p)
        out.peak[d * n + p] = PeakWith(law, out.factors[p], out.factors[d], plants);
  };
  auto odd = std::async(std::launch::async, [&] { rows(1); });
  rows(0);
  odd.get();
  return out;
}

}  // namespace levitas::design
