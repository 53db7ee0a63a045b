#include "numerics/minimum/evolution_strategy.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "common/each_in_parallel.hpp"
#include "common/random.hpp"
#include "numerics/dense/eigenvalues.hpp"

namespace levitas::numerics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Constants of the tutorial's table 1, for n unknowns and lambda points a generation.
struct Constants {
  Constants(Index n, Index lambda) : weights(lambda / 2) {
    const auto size = static_cast<double>(n);
    for (Index i = 0; i < weights.size(); ++i)
      weights(i) = std::log(0.5 * (static_cast<double>(lambda) + 1.0)) -
                   std::log(static_cast<double>(i) + 1.0);
    weights /= weights.sum();
    mu = 1.0 / weights.squaredNorm();
    c_sigma = (mu + 2.0) / (size + mu + 5.0);
    d_sigma = 1.0 + 2.0 * std::max(0.0, std::sqrt((mu - 1.0) / (size + 1.0)) - 1.0) + c_sigma;
    c_c = (4.0 + mu / size) / (size + 4.0 + 2.0 * mu / size);
    c_1 = 2.0 / ((size + 1.3) * (size + 1.3) + mu);
    c_mu = std::min(1.0 - c_1, 2.0 * (mu - 2.0 + 1.0 / mu) / ((size + 2.0) * (size + 2.0) + mu));
    length = std::sqrt(size) * (1.0 - 1.0 / (4.0 * size) + 1.0 / (21.0 * size * size));
  }
  VectorXd weights;
  double mu{}, c_sigma{}, d_sigma{}, c_c{}, c_1{}, c_mu{};
  double length{};  ///< expected, of a normal vector
};

/// Mean, step, covariance and the two paths.
struct Distribution {
  Distribution(const VectorXd& start, double step)
      : mean(start),
        sigma(step),
        covariance(MatrixXd::Identity(start.size(), start.size())),
        path_sigma(VectorXd::Zero(start.size())),
        path_c(path_sigma) {}

  /// `solver`: of the covariance that the steps were drawn with.
  void Update(const Constants& at, const Eigen::SelfAdjointEigenSolver<MatrixXd>& solver,
              const MatrixXd& steps, std::size_t generation) {
    const VectorXd shift = steps * at.weights;
    mean += sigma * shift;
    const VectorXd root = solver.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
    const VectorXd white =
        solver.eigenvectors() * (solver.eigenvectors().transpose() * shift).cwiseQuotient(root);
    path_sigma = (1.0 - at.c_sigma) * path_sigma +
                 std::sqrt(at.c_sigma * (2.0 - at.c_sigma) * at.mu) * white;
    const double grown =
        path_sigma.norm() /
        std::sqrt(1.0 - std::pow(1.0 - at.c_sigma, 2.0 * static_cast<double>(generation)));
    const bool moving = grown < (1.4 + 2.0 / (static_cast<double>(mean.size()) + 1.0)) * at.length;
    path_c = (1.0 - at.c_c) * path_c;
    if (moving) path_c += std::sqrt(at.c_c * (2.0 - at.c_c) * at.mu) * shift;
    const double lost = moving ? 0.0 : at.c_1 * at.c_c * (2.0 - at.c_c);
    covariance = (1.0 - at.c_1 - at.c_mu + lost) * covariance +
                 at.c_1 * path_c * path_c.transpose() +
                 at.c_mu * steps * at.weights.asDiagonal() * steps.transpose();
    sigma *= std::exp(at.c_sigma / at.d_sigma * (path_sigma.norm() / at.length - 1.0));
  }

  VectorXd mean;
  double sigma;
  MatrixXd covariance;
  VectorXd path_sigma, path_c;
};

/// The steps of least cost, as columns.
MatrixXd Best(const std::vector<VectorXd>& steps, const std::vector<double>& costs, Index kept) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
  MatrixXd best(steps.front().size(), kept);
  for (Index i = 0; i < kept; ++i) best.col(i) = steps[order[static_cast<std::size_t>(i)]];
  return best;
}

}  // namespace

EvolutionResult Evolve(const VectorXd& start, const std::function<double(const VectorXd&)>& cost,
                       const EvolutionOptions& options,
                       const std::function<bool(std::size_t, double)>& seen) {
  constexpr double kWorst = std::numeric_limits<double>::infinity();
  const auto worth = [&](const VectorXd& x) {
    const double value = cost(x);
    return std::isnan(value) ? kWorst : value;
  };
  const Index n = start.size();
  const auto lambda = options.population > 0
                          ? static_cast<Index>(options.population)
                          : 4 + static_cast<Index>(3.0 * std::log(static_cast<double>(n)));
  const Constants constants(n, lambda);
  Distribution now(start, options.first_step);
  EvolutionResult out{start, worth(start), 1};
  Random draw(options.seed);
  bool going = seen(out.evaluations, out.cost);
  for (std::size_t generation = 1; going && out.evaluations < options.evaluations; ++generation) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(now.covariance);
    const MatrixXd root =
        solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
    const auto left = static_cast<Index>(options.evaluations - out.evaluations);
    const bool whole = lambda <= left;
    std::vector<VectorXd> steps;
    for (Index i = 0; i < std::min(lambda, left); ++i)
      steps.emplace_back(root * VectorXd::NullaryExpr(n, [&] { return draw.Normal(); }));
    const auto point = [&](std::size_t i) -> VectorXd { return now.mean + now.sigma * steps[i]; };
    std::vector<double> costs(steps.size());
    EachInParallel(steps.size(), options.threads,
                   [&](std::size_t i) { costs[i] = worth(point(i)); });
    for (std::size_t i = 0; i < steps.size() && going; ++i) {
      ++out.evaluations;
      if (costs[i] < out.cost) {
        out.cost = costs[i];
        out.best = point(i);
      }
      going = seen(out.evaluations, out.cost);
    }
    if (!whole || !going) break;
    now.Update(constants, solver, Best(steps, costs, constants.weights.size()), generation);
  }
  return out;
}

}  // namespace levitas::numerics
