#include "identification/modal/uncertainty.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "numerics/dense/eigenvalues.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

/// Components of a unit vector below this do not count as part of the direction.
constexpr double kPart = 0.2;

std::string ExperimentFor(const std::vector<std::string>& unknowns) {
  constexpr std::array<std::pair<const char*, const char*>, 10> kExperiments{{
      {"mass", "weigh the rotor, or hang a known weight on it while it levitates"},
      {"sensor_gain",
       "push the rotor from stop to stop of the touchdown bearings, whose clearance "
       "is known, or compare with a dial gauge"},
      {"centre_z", "balance the rotor on a knife edge"},
      {"transverse_inertia", "swing the rotor on two threads and count"},
      {"ki_", "levitate with a known static load and read the change of current"},
      {"ks_", "levitate at two reference positions and read the change of current"},
      {"delay", "record the coil current beside the command"},
      {"amplifier", "record the coil current beside the command"},
      {"gyroscopic", "excite at a higher speed of rotation"},
      {"", "excite more strongly, or for more periods, near the mode concerned"},
  }};
  for (const auto& [prefix, experiment] : kExperiments) {
    for (const std::string& name : unknowns) {
      if (name.starts_with(prefix)) return experiment;
    }
  }
  return {};
}

/// The unknowns that an eigenvector of the information moves, the largest part first.
Unidentifiable DirectionOf(const ModalStart& start, const std::vector<Index>& free,
                           const Eigen::VectorXd& eigenvector) {
  std::vector<std::pair<double, Index>> parts;
  for (Index k = 0; k < static_cast<Index>(free.size()); ++k) {
    const double part = std::abs(eigenvector[k]);
    if (part > kPart) parts.emplace_back(-part, free[static_cast<std::size_t>(k)]);
  }
  std::ranges::sort(parts);
  Unidentifiable direction;
  for (const auto& [part, unknown] : parts) {
    direction.unknowns.push_back(start.names[static_cast<std::size_t>(unknown)]);
  }
  direction.experiment = ExperimentFor(direction.unknowns);
  return direction;
}

std::vector<Index> FittedUnknowns(const ModalFit& fit) {
  std::vector<Index> free;
  for (std::size_t k = 0; k < fit.fitted.size(); ++k) {
    if (fit.fitted[k]) free.push_back(static_cast<Index>(k));
  }
  return free;
}

/// Covariances of the free unknowns in units of their priors.
struct Covariance {
  double scale{1.0};      ///< of `noise`: what the lines scatter beyond their own noise
  Eigen::MatrixXd noise;  ///< from the lines' own noise
  Eigen::MatrixXd seen;   ///< from the misfit that neighbouring lines share

  /// Standard deviation. Shared misfit counts as it is shown (Huber 1967): the larger of both.
  double Deviation(const Eigen::VectorXd& direction) const {
    return std::sqrt(
        std::max(scale * direction.dot(noise * direction), direction.dot(seen * direction)));
  }
};

using Information = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

Covariance CovarianceOf(const Information& solver, const ModalFit& fit,
                        const std::vector<Index>& free, const Eigen::VectorXd& prior) {
  const Eigen::VectorXd spread = (solver.eigenvalues().array().max(0.0) + 1.0).inverse();
  Covariance covariance;
  covariance.noise =
      solver.eigenvectors() * spread.asDiagonal() * solver.eigenvectors().transpose();
  covariance.seen = covariance.noise *
                    (prior.asDiagonal() * fit.scatter(free, free) * prior.asDiagonal() +
                     Eigen::MatrixXd::Identity(prior.size(), prior.size())) *
                    covariance.noise;
  covariance.scale = std::max(1.0, fit.reduced_chi_square);
  return covariance;
}

/// Uncertainty::products.
Eigen::VectorXd ProductDeviations(const ModalLayout& at, const std::vector<Index>& free,
                                  const Eigen::VectorXd& prior, const Covariance& covariance) {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(prior.size());
  const auto sum_of = [&](std::initializer_list<std::pair<Index, double>> terms) {
    product.setZero();
    for (const auto& [unknown, factor] : terms) {
      const auto found = std::ranges::find(free, unknown);
      const Index k = found - free.begin();
      if (found != free.end()) product[k] = factor * prior[k];
    }
    return covariance.Deviation(product);
  };
  Eigen::VectorXd products(2 * at.axes());
  for (Index axis = 0; axis < at.axes(); ++axis) {
    products[axis] = sum_of({{at.ki + axis, 1.0}, {at.gain + axis, 1.0}, {at.mass, -1.0}});
    products[at.axes() + axis] = sum_of({{at.ks + axis, 1.0}, {at.mass, -1.0}});
  }
  return products;
}

}  // namespace

Uncertainty Assess(const ModalStart& start, const ModalFit& fit) {
  const std::vector<Index> free = FittedUnknowns(fit);
  const Eigen::VectorXd prior = start.prior(free);
  // In units of the priors: information of the prior is the identity.
  const Eigen::MatrixXd data =
      prior.asDiagonal() * fit.information(free, free) * prior.asDiagonal();
  const Information solver(data);
  const Covariance covariance = CovarianceOf(solver, fit, free, prior);
  Uncertainty result{Eigen::VectorXd::Zero(start.vector.size()), {}, {}};
  const auto count = static_cast<Index>(free.size());
  for (Index k = 0; k < count; ++k) {
    const Eigen::VectorXd unit = prior[k] * Eigen::VectorXd::Unit(count, k);
    result.deviation[free[static_cast<std::size_t>(k)]] = covariance.Deviation(unit);
  }
  result.products = ProductDeviations(start.frame.layout, free, prior, covariance);
  for (Index n = 0; n < solver.eigenvalues().size() && solver.eigenvalues()[n] < 1.0; ++n) {
    result.directions.push_back(DirectionOf(start, free, solver.eigenvectors().col(n)));
  }
  return result;
}

}  // namespace levitas::identification
