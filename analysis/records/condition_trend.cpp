#include "analysis/records/condition_trend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/rotational_speed.hpp"

namespace levitas::analysis {
namespace {

constexpr double kSpeedShare = 0.005;
constexpr double kMeshShare = 0.25;
constexpr double kMeanShare = 0.05;
constexpr double kAlike = 2.0;  // factor between the growths per line of one pulse a turn

/// Probability of every number of inversions of `count` values without a trend.
std::vector<double> Inversions(std::size_t count) {
  std::vector<double> chance{1.0};
  for (std::size_t n = 2; n <= count; ++n) {
    std::vector<double> next(chance.size() + n - 1, 0.0);
    for (std::size_t i = 0; i < chance.size(); ++i) {
      for (std::size_t k = 0; k < n; ++k) next[i + k] += chance[i] / static_cast<double>(n);
    }
    chance = std::move(next);
  }
  return chance;
}

double MeanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

struct Baseline {
  double mean{};
  double scatter{};
};

Baseline BaselineOf(const std::vector<GearCondition>& sessions, std::size_t shaft,
                    std::size_t count) {
  std::vector<double> energies;
  double uncertain = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Measured& energy = sessions[i].shafts[shaft].energy_m2;
    energies.push_back(energy.value);
    uncertain += energy.deviation * energy.deviation / static_cast<double>(count);
  }
  Baseline of{MeanOf(energies), 0.0};
  for (const double energy : energies) of.scatter += (energy - of.mean) * (energy - of.mean);
  if (count > 1) of.scatter /= static_cast<double>(count - 1);
  of.scatter = std::sqrt(std::max(of.scatter, uncertain));
  return of;
}

/// Growth of every line of the last session over the baseline [m2].
std::vector<double> GrowthOf(const std::vector<GearCondition>& sessions, std::size_t shaft,
                             std::size_t count) {
  std::vector<double> growth = sessions.back().shafts[shaft].line_m2;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& lines = sessions[i].shafts[shaft].line_m2;
    for (std::size_t k = 0; k < growth.size() && k < lines.size(); ++k) {
      growth[k] -= lines[k] / static_cast<double>(count);
    }
  }
  return growth;
}

double LinesOf(const std::vector<double>& growth) {
  const double sum = std::accumulate(growth.begin(), growth.end(), 0.0);
  const double square = std::inner_product(growth.begin(), growth.end(), growth.begin(), 0.0);
  return square > 0.0 ? sum * sum / square : 0.0;
}

ShaftTrend Follow(const std::vector<GearCondition>& sessions, std::size_t shaft,
                  const TrendRule& rule) {
  const ShaftCondition& last = sessions.back().shafts[shaft];
  ShaftTrend trend;
  trend.shaft = last.shaft;
  trend.wheels = last.wheels;
  const Baseline baseline = BaselineOf(sessions, shaft, rule.baseline);
  std::vector<double> amplitudes;
  double once_m = 0.0;
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const ShaftCondition& of = sessions[i].shafts[shaft];
    const double own = std::max(of.energy_m2.deviation, baseline.scatter);
    const double shared = baseline.scatter * baseline.scatter / static_cast<double>(rule.baseline);
    trend.rise.push_back((of.energy_m2.value - baseline.mean) / std::sqrt(own * own + shared));
    amplitudes.push_back(of.Amplitude());
    if (i < rule.baseline) once_m += of.once_m / static_cast<double>(rule.baseline);
  }
  trend.rises_from_m = std::sqrt(
      std::max(0.0, baseline.mean + rule.rise * baseline.scatter *
                                        std::sqrt(1.0 + 1.0 / static_cast<double>(rule.baseline))));
  trend.amplitude_m = RobustSlope(amplitudes, rule.confidence);
  trend.lines = LinesOf(GrowthOf(sessions, shaft, rule.baseline));
  trend.once_ratio = once_m > 0.0 ? last.once_m / once_m : 1.0;
  trend.risen = trend.rise.back() >= rule.rise && trend.lines >= rule.least_lines;
  return trend;
}

bool Differs(double value, double first, double tolerance) {
  return std::abs(value - first) > tolerance;
}

}  // namespace

Slope RobustSlope(const std::vector<double>& values, double confidence) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t k = i + 1; k < values.size(); ++k) {
      slopes.push_back((values[k] - values[i]) / static_cast<double>(k - i));
    }
  }
  std::sort(slopes.begin(), slopes.end());
  const std::size_t count = slopes.size();
  // The true slope lies below the slope of rank c with the chance of at most c inversions.
  const auto chance = Inversions(values.size());
  std::size_t cut = 0;
  double below = chance[0];
  while (2 * (cut + 1) < count && 1.0 - 2.0 * (below + chance[cut + 1]) >= confidence) {
    below += chance[++cut];
  }
  return {0.5 * (slopes[(count - 1) / 2] + slopes[count / 2]), slopes[cut], slopes[count - 1 - cut],
          std::max(0.0, 1.0 - 2.0 * below)};
}

std::vector<ShaftTrend> FollowCondition(const std::vector<GearCondition>& sessions,
                                        const TrendRule& rule) {
  std::vector<ShaftTrend> trends;
  if (rule.baseline == 0 || sessions.size() <= rule.baseline) return trends;
  const std::size_t shafts = sessions.front().shafts.size();
  for (const GearCondition& of : sessions) {
    if (of.shafts.size() != shafts) return trends;
  }
  for (std::size_t s = 0; s < shafts; ++s) trends.push_back(Follow(sessions, s, rule));
  const auto per_line = [&](std::size_t s) {
    const auto growth = GrowthOf(sessions, s, rule.baseline);
    return growth.empty() ? 0.0 : MeanOf(growth);
  };
  for (std::size_t s = 0; s < shafts; ++s) {
    for (const std::size_t other : sessions.back().shafts[s].shared) {
      for (std::size_t o = 0; o < shafts; ++o) {
        if (trends[o].shaft != other || !(trends[o].risen || trends[s].risen)) continue;
        const double growth = per_line(s);
        const double own = per_line(o);
        const bool alike = growth < kAlike * own && kAlike * growth > own;
        ShaftTrend& cause = alike ? trends[o] : trends[s];
        ShaftTrend& follows = alike ? trends[s] : trends[o];
        if (alike && (!rule.loaded || !trends[o].risen)) cause.or_else = follows.shaft;
        cause.risen = true;
        follows.risen = false;
        follows.explained_by = cause.shaft;
      }
    }
  }
  return trends;
}

std::vector<std::string> Reasons(const std::vector<GearCondition>& sessions,
                                 const plant::PlantConfig& rig) {
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const GearCondition& of = sessions[i];
    const GearCondition& first = sessions.front();
    const auto add = [&](const std::string& what) {
      reasons.push_back(fmt::format("session {}: {}", i + 1, what));
    };
    if (of.repeats < kLeastRepeats) {
      add(fmt::format("holds its speed for {} repeats of all wheels, needed {}", of.repeats,
                      kLeastRepeats));
      continue;
    }
    if (Differs(of.speed_rad_per_s, first.speed_rad_per_s,
                kSpeedShare * std::abs(first.speed_rad_per_s))) {
      add(fmt::format("speed {:.1f} rpm, the first {:.1f} rpm", RadPerSToRpm(of.speed_rad_per_s),
                      RadPerSToRpm(first.speed_rad_per_s)));
    }
    if (Differs(of.mesh_m, first.mesh_m, kMeshShare * first.mesh_m)) {
      add(fmt::format(
          "lines of the mesh {:.3g} um, the first {:.3g} um: another load, or all teeth "
          "have changed",
          1e6 * of.mesh_m, 1e6 * first.mesh_m));
    }
    for (std::size_t a = 0; a < of.mean_position_m.size(); ++a) {
      const plant::BearingConfig& bearing = rig.bearings[a / 2];
      const bool moved = Differs(of.mean_position_m[a], first.mean_position_m[a],
                                 kMeanShare * bearing.touchdown.clearance_m);
      const bool loaded = Differs(of.mean_current_a[a], first.mean_current_a[a],
                                  kMeanShare * bearing.magnet.bias_current_a);
      if (!moved && !loaded) continue;
      add(
          fmt::format("mean position or current of {}_{} differs from the first by {:.3g} um, "
                      "{:.3g} A: another static load",
                      bearing.name, a % 2 == 0 ? 'x' : 'y',
                      1e6 * (of.mean_position_m[a] - first.mean_position_m[a]),
                      of.mean_current_a[a] - first.mean_current_a[a]));
    }
  }
  return reasons;
}

}  // namespace levitas::analysis
