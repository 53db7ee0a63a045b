#include "design/synthesis/matrix_sign.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "numerics/dense/factorisations.hpp"

namespace levitas::synthesis {

std::optional<Eigen::MatrixXd> MatrixSign(const Eigen::MatrixXd& matrix) {
  // Each step about halves the distance of the worst eigenvalue's logarithm, then squares it; 60
  // steps reach eigenvalues within 1e-15 of the axis, which rounding cannot tell from it.
  constexpr int kMostSteps = 60;
  constexpr double kSettled = 1e-13;
  const auto n = static_cast<double>(matrix.rows());
  Eigen::MatrixXd Z = matrix;
  double previous = INFINITY;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(Z);
    const double log_determinant = lu.matrixLU().diagonal().cwiseAbs().array().log().sum();
    if (!std::isfinite(log_determinant)) return std::nullopt;
    const double scale = previous < 1e-2 ? 1.0 : std::exp(-log_determinant / n);
    const Eigen::MatrixXd next = 0.5 * (scale * Z + lu.inverse() / scale);
    if (!next.allFinite()) return std::nullopt;
    const double change = (next - Z).lpNorm<1>() / next.lpNorm<1>();
    Z = next;
    // Quadratic convergence: once small and no longer falling, only rounding is left.
    if (change < kSettled || (change < 1e-7 && change >= previous)) return Z;
    previous = change;
  }
  return previous < 1e-7 ? std::optional(Z) : std::nullopt;
}

}  // namespace levitas::synthesis
