#include "design/search/weight_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/problem.hpp"
#include "numerics/minimum/evolution_strategy.hpp"

namespace levitas::design {
namespace {

/// The weights that are moved, one after another.
std::vector<double*> Moved(hinf::HinfWeights& weights, std::size_t bearings, std::size_t modes) {
  weights.bearing_disturbance.resize(bearings, 1.0);
  weights.bearing_position.resize(bearings, 1.0);
  weights.mode_share.resize(modes, 1.0);
  std::vector<double*> out{&weights.disturbance_a,     &weights.disturbance_hz,
                           &weights.disturbance_floor, &weights.disc_ratio,
                           &weights.disc_hz,           &weights.noise_m,
                           &weights.control_a,         &weights.control_hz,
                           &weights.position_m,        &weights.position_hz};
  for (std::size_t b = 1; b < bearings; ++b) {
    out.push_back(&weights.bearing_disturbance[b]);
    out.push_back(&weights.bearing_position[b]);
  }
  for (double& share : weights.mode_share) out.push_back(&share);
  if (weights.speed_ratio > 0.0) out.push_back(&weights.speed_unit);
  return out;
}

hinf::HinfWeights WeightsAt(const Eigen::VectorXd& x, hinf::HinfWeights weights,
                            std::size_t bearings, std::size_t modes) {
  const auto moved = Moved(weights, bearings, modes);
  for (std::size_t i = 0; i < moved.size(); ++i)
    *moved[i] *= std::exp(x(static_cast<Eigen::Index>(i)));
  weights.disturbance_floor = std::min(weights.disturbance_floor, 1.0);
  return weights;
}

}  // namespace

double CostOf(const LoopFigures& f, const SearchGoals& goals) {
  if (!f.stable) return 20.0 + 1000.0 * std::max(0.0, f.pole_modulus - 1.0);
  const std::array<double, 4> ratios{f.mu / goals.mu, f.sensitivity / goals.sensitivity,
                                     f.orbit_m / goals.orbit_m, f.current_a / goals.current_a};
  double sum = 0.0;
  for (const double ratio : ratios) sum += ratio;
  return *std::max_element(ratios.begin(), ratios.end()) + 0.1 * sum / 4.0;
}

SearchResult SearchWeights(const configuration::RigFile& rig, const hinf::HinfWeights& start,
                           const hinf::HinfDesignOptions& design, const FigureMaker& figures,
                           const SearchOptions& options,
                           const std::function<bool(std::size_t, double)>& seen) {
  constexpr double kNoLaw = 1000.0;
  constexpr std::size_t kModes = 5;
  const std::size_t bearings = rig.plant.bearings.size();
  const auto cost = [&](const Eigen::VectorXd& x) {
    try {
      const auto made = hinf::MakeLaw(rig.plant, WeightsAt(x, start, bearings, kModes), design);
      double sum = CostOf(figures.Of(made.law), options.goals);
      if (!(made.slowest_pole_1_per_s > 0.0)) sum += 2.0 + std::log1p(-made.slowest_pole_1_per_s);
      return sum;
    } catch (const Problem&) {
      return kNoLaw;
    }
  };
  hinf::HinfWeights copy = start;
  const auto unknowns = static_cast<Eigen::Index>(Moved(copy, bearings, kModes).size());
  numerics::EvolutionOptions evolution;
  evolution.evaluations = options.evaluations;
  evolution.first_step = options.first_step;
  evolution.seed = options.seed;
  evolution.population = 12;
  evolution.threads = 0;
  const auto found = numerics::Evolve(Eigen::VectorXd::Zero(unknowns), cost, evolution, seen);
  return {WeightsAt(found.best, start, bearings, kModes), found.cost, found.evaluations};
}

}  // namespace levitas::design
