#include "analysis/loop_response.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"
#include "numerics/dense/orthogonal_factor.hpp"

namespace levitas::analysis {
namespace {

/// Solves (z I - H) X = R in place for an upper Hessenberg H: elimination with row exchange of the
/// one sub-diagonal entry per column, then back substitution.
void SolveHessenberg(std::complex<double> z, const Eigen::MatrixXd& hessenberg,
                     Eigen::MatrixXcd& right) {
  const Eigen::Index n = hessenberg.rows();
  Eigen::MatrixXcd matrix = -hessenberg.cast<std::complex<double>>();
  matrix.diagonal().array() += z;
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    const Eigen::Index rest = n - k;
    if (std::norm(matrix(k + 1, k)) > std::norm(matrix(k, k))) {
      matrix.row(k).tail(rest).swap(matrix.row(k + 1).tail(rest));
      right.row(k).swap(right.row(k + 1));
    }
    if (matrix(k + 1, k) == 0.0) continue;
    const std::complex<double> factor = matrix(k + 1, k) / matrix(k, k);
    matrix.row(k + 1).tail(rest) -= factor * matrix.row(k).tail(rest);
    right.row(k + 1) -= factor * right.row(k);
  }
  matrix.triangularView<Eigen::Upper>().solveInPlace(right);
}

}  // namespace

LoopResponse::LoopResponse(const SampledLoop& loop) : loop_(loop) {
  const Eigen::HessenbergDecomposition<Eigen::MatrixXd> reduced(loop.plant.a);
  const Eigen::MatrixXd q = numerics::OrthogonalFactor(reduced);
  hessenberg_ = reduced.matrixH();
  input_ = (q.transpose() * loop.plant.b).cast<std::complex<double>>();
  output_ = (loop.plant.c * q).cast<std::complex<double>>();
}

std::complex<double> LoopResponse::Point(double frequency_hz) const {
  return std::polar(1.0, 2.0 * std::numbers::pi * frequency_hz * loop_.period_s);
}

Eigen::MatrixXcd LoopResponse::Plant(double frequency_hz) const {
  Eigen::MatrixXcd state = input_;
  SolveHessenberg(Point(frequency_hz), hessenberg_, state);
  return output_ * state;
}

Eigen::MatrixXcd LoopResponse::Sensitivity(double frequency_hz) const {
  Eigen::MatrixXcd open = Plant(frequency_hz);
  const std::complex<double> z = Point(frequency_hz);
  if (loop_.coupled) open = open * loop_.coupled->At(z);
  for (std::size_t i = 0; i < loop_.law.size(); ++i) {
    open.col(static_cast<Eigen::Index>(i)) *= loop_.law[i].At(z);
  }
  open.diagonal().array() += 1.0;
  return open.inverse();
}

double LargestSingularValue(const Eigen::MatrixXcd& matrix) {
  const Eigen::MatrixXcd gram = matrix.adjoint() * matrix;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(gram, Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues().maxCoeff());
}

}  // namespace levitas::analysis
