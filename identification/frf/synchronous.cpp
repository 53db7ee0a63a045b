#include "identification/frf/synchronous.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace levitas::identification {

std::vector<double> WithoutSynchronous(std::span<const double> signal,
                                       std::span<const double> angle_rad, int orders) {
  const Eigen::Index size = 1 + 2 * orders;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  Eigen::VectorXd basis(size);
  const auto fill = [&](double angle) {
    basis[0] = 1.0;
    for (int k = 1; k <= orders; ++k) {
      basis[2 * k - 1] = std::cos(k * angle);
      basis[2 * k] = std::sin(k * angle);
    }
  };
  for (std::size_t n = 0; n < signal.size(); ++n) {
    fill(angle_rad[n]);
    normal.noalias() += basis * basis.transpose();
    right += basis * signal[n];
  }
  const Eigen::VectorXd weights = normal.ldlt().solve(right);
  std::vector<double> rest(signal.begin(), signal.end());
  for (std::size_t n = 0; n < rest.size(); ++n) {
    fill(angle_rad[n]);
    rest[n] -= basis.dot(weights);
  }
  return rest;
}

}  // namespace levitas::identification
