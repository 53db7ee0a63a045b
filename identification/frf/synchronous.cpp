#include "identification/frf/synchronous.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "numerics/dense/factorisations.hpp"

namespace levitas::identification {

std::vector<double> WithoutSynchronous(std::span<const double> signal,
                                       std::span<const double> angle_rad, int orders,
                                       double cycles_per_sample) {
  const Eigen::Index removed = 1 + 2 * orders;
  const Eigen::Index size = removed + (cycles_per_sample > 0.0 ? 2 : 0);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  Eigen::VectorXd basis(size);
  const auto fill = [&](std::size_t n) {
    const double angle = angle_rad[n];
    basis[0] = 1.0;
    for (int k = 1; k <= orders; ++k) {
      basis[2 * k - 1] = std::cos(k * angle);
      basis[2 * k] = std::sin(k * angle);
    }
    if (size == removed) return;
    const double test = 2.0 * std::numbers::pi * cycles_per_sample * static_cast<double>(n);
    basis[removed] = std::cos(test);
    basis[removed + 1] = std::sin(test);
  };
  for (std::size_t n = 0; n < signal.size(); ++n) {
    fill(n);
    normal.noalias() += basis * basis.transpose();
    right += basis * signal[n];
  }
  const Eigen::VectorXd weights = normal.ldlt().solve(right);
  std::vector<double> rest(signal.begin(), signal.end());
  for (std::size_t n = 0; n < rest.size(); ++n) {
    fill(n);
    rest[n] -= basis.head(removed).dot(weights.head(removed));
  }
  return rest;
}

}  // namespace levitas::identification
