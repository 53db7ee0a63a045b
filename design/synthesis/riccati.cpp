#include "design/synthesis/riccati.hpp"

#include <Eigen/Dense>

#include "design/synthesis/matrix_sign.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::synthesis {

namespace {

Eigen::MatrixXd Symmetric(const Eigen::MatrixXd& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

/// Without the corrections.
std::optional<Eigen::MatrixXd> FromSign(const Eigen::MatrixXd& A, const Eigen::MatrixXd& G,
                                        const Eigen::MatrixXd& Q) {
  const Eigen::Index n = A.rows();
  Eigen::MatrixXd H(2 * n, 2 * n);
  H << A, -G, -Q, -A.transpose();
  const auto sign = MatrixSign(H);
  if (!sign) return std::nullopt;
  // (sign + I) [I; X] = 0: the columns of [I; X] span the stable subspace.
  Eigen::MatrixXd left = sign->rightCols(n);
  left.bottomRows(n).diagonal().array() += 1.0;
  Eigen::MatrixXd right = sign->leftCols(n);
  right.topRows(n).diagonal().array() += 1.0;
  Eigen::MatrixXd X = left.householderQr().solve(-right);
  if (!X.allFinite()) return std::nullopt;
  return Symmetric(X);
}

}  // namespace

std::optional<Eigen::MatrixXd> SolveRiccati(const Eigen::MatrixXd& A, const Eigen::MatrixXd& G,
                                            const Eigen::MatrixXd& Q, double q_terms) {
  constexpr int kMostCorrections = 3;
  constexpr double kRounding = 1e-13;
  if (A.rows() == 0) return Eigen::MatrixXd(0, 0);
  auto X = FromSign(A, G, Q);
  if (!X) return std::nullopt;
  const auto residual = [&](const Eigen::MatrixXd& x) {
    return Symmetric(A.transpose() * x + x * A - x * G * x + Q);
  };
  const auto share = [&](const Eigen::MatrixXd& x, const Eigen::MatrixXd& left) {
    return left.norm() / (2.0 * (A.transpose() * x).norm() + (x * G * x).norm() + Q.norm() +
                          kRounding / kRiccatiResidual * q_terms + 1e-300);
  };
  Eigen::MatrixXd left = residual(*X);
  double error = share(*X, left);
  for (int step = 0; step < kMostCorrections && error > kRounding; ++step) {
    const auto correction = FromSign(A - G * *X, G, left);
    if (!correction) break;
    const Eigen::MatrixXd better = *X + *correction;
    const Eigen::MatrixXd better_left = residual(better);
    const double better_error = share(better, better_left);
    if (!(better_error < error)) break;
    X = better;
    left = better_left;
    error = better_error;
  }
  if (!(error < kRiccatiResidual)) return std::nullopt;
  return X;
}

std::optional<Eigen::MatrixXd> SolveLyapunov(const Eigen::MatrixXd& A, const Eigen::MatrixXd& Q) {
  return SolveRiccati(A, Eigen::MatrixXd::Zero(A.rows(), A.cols()), Q);
}

}  // namespace levitas::synthesis
