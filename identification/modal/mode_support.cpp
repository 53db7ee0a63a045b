#include "identification/modal/mode_support.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "numerics/dense/eigenvalues.hpp"

namespace levitas::identification {
namespace {

constexpr double kLeftOut = 0.25;
constexpr double kSamePole = 0.01;
/// With more, only the nearest pairing is looked at: there are too many others.
constexpr std::size_t kMostModes = 14;

bool SamePairing(const Assigned& one, const Assigned& other) {
  return std::ranges::equal(one, other, [](const auto& a, const auto& b) {
    return a.has_value() == b.has_value() && (!a || a->frequency_hz == b->frequency_hz);
  });
}

}  // namespace

Assigned AssignModes(const std::vector<double>& model_hz, const std::vector<ProposedMode>& shown) {
  const std::size_t n = model_hz.size();
  const std::size_t m = shown.size();
  // cost[i][j]: least cost of the first i modes and the first j of the diagram.
  std::vector<std::vector<double>> cost(n + 1, std::vector<double>(m + 1, 0.0));
  std::vector<std::vector<std::uint8_t>> step(n + 1, std::vector<std::uint8_t>(m + 1, 0));
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t j = 0; j <= m; ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = kLeftOut * static_cast<double>(i + j);
        step[i][j] = i == 0 ? 2 : 1;
        continue;
      }
      const double pair =
          cost[i - 1][j - 1] + std::abs(std::log(model_hz[i - 1] / shown[j - 1].frequency_hz));
      const double without_model = cost[i - 1][j] + kLeftOut;
      const double without_data = cost[i][j - 1] + kLeftOut;
      cost[i][j] = std::min({pair, without_model, without_data});
      step[i][j] = cost[i][j] == pair ? 0 : (cost[i][j] == without_model ? 1 : 2);
    }
  }
  Assigned assigned(n);
  for (std::size_t i = n, j = m; i > 0 && j > 0;) {
    const std::uint8_t taken = step[i][j];
    if (taken == 0) assigned[i - 1] = shown[j - 1];
    if (taken != 2) --i;
    if (taken != 1) --j;
  }
  return assigned;
}

std::vector<Assigned> PairModes(const std::vector<double>& model_hz,
                                const std::vector<ProposedMode>& shown, std::size_t most) {
  const std::size_t n = model_hz.size();
  const std::size_t m = shown.size();
  std::vector<Assigned> pairings{AssignModes(model_hz, shown)};
  std::vector<Assigned> all;
  std::vector<std::pair<double, std::size_t>> by_distance;
  const std::size_t longer = std::max(n, m);
  if (longer > kMostModes) return pairings;
  for (std::uint32_t takes_part = 0; takes_part < (1U << longer); ++takes_part) {
    if (static_cast<std::size_t>(std::popcount(takes_part)) != std::min(n, m)) continue;
    double distance = 0.0;
    Assigned one(n);
    std::size_t shorter = 0;
    for (std::size_t k = 0; k < longer; ++k) {
      if ((takes_part >> k & 1U) == 0U) continue;
      const std::size_t i = n >= m ? k : shorter;
      const std::size_t j = n >= m ? shorter : k;
      distance += std::abs(std::log(model_hz[i] / shown[j].frequency_hz));
      one[i] = shown[j];
      ++shorter;
    }
    by_distance.emplace_back(distance, all.size());
    all.push_back(std::move(one));
  }
  std::ranges::sort(by_distance);
  for (const auto& [distance, at] : by_distance) {
    if (pairings.size() >= most) break;
    if (!SamePairing(all[at], pairings.front())) pairings.push_back(all[at]);
  }
  return pairings;
}

std::vector<double> PlantFrequenciesHz(const Physical& rig, bool y_plane) {
  Eigen::MatrixXd stiffness = rig.frequency_rad_per_s.cwiseAbs2().asDiagonal();
  for (Eigen::Index b = 0; b < rig.actuator.cols(); ++b) {
    const double ks = rig.ks_n_per_m[2 * b + (y_plane ? 1 : 0)];
    stiffness -= ks * rig.actuator.col(b) * rig.actuator.col(b).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, Eigen::EigenvaluesOnly);
  std::vector<double> frequencies;
  for (Eigen::Index i = 0; i < stiffness.rows(); ++i) {
    const double square = solver.eigenvalues()[i];
    if (square > 0.0) frequencies.push_back(std::sqrt(square) / (2.0 * std::numbers::pi));
  }
  return frequencies;
}

std::vector<ModeSupport> SupportOf(const Physical& rig, const Assigned& assigned) {
  const std::vector<double> x = PlantFrequenciesHz(rig, false);
  const std::vector<double> y = PlantFrequenciesHz(rig, true);
  std::vector<ModeSupport> support(assigned.size());
  for (std::size_t i = 0; i < assigned.size(); ++i) {
    ModeSupport& mode = support[i];
    // The highest ones are the bending modes; the rigid ones are unstable or far below.
    const auto from_end = assigned.size() - i;
    if (from_end <= std::min(x.size(), y.size())) {
      mode.plant_hz = 0.5 * (x[x.size() - from_end] + y[y.size() - from_end]);
    }
    mode.support = Support::kNotShown;
    if (!assigned[i]) continue;
    mode.shown_hz = assigned[i]->frequency_hz;
    const double apart = std::abs(mode.plant_hz / mode.shown_hz - 1.0);
    mode.support = apart < kSamePole ? Support::kShown : Support::kMoved;
  }
  return support;
}

}  // namespace levitas::identification
