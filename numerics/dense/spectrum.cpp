#include "numerics/dense/spectrum.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "numerics/dense/eigenvalues.hpp"

namespace levitas::numerics {
namespace {

using Eigen::Index;

/// A direction without a pattern that a model could share, another one for each way.
Eigen::VectorXd Direction(Index size, int way) {
  Eigen::VectorXd v(size);
  for (Index i = 0; i < size; ++i) {
    v[i] = std::sin(1.7 * static_cast<double>(way) + 0.9 * static_cast<double>(i * i + i));
  }
  return v.normalized();
}

Spectrum NoNumbers(Index size, bool vectors) {
  const std::complex<double> none(std::numeric_limits<double>::quiet_NaN(), 0.0);
  Spectrum out{Eigen::VectorXcd::Constant(size, none), {}};
  if (vectors) out.vectors = Eigen::MatrixXcd::Constant(size, size, none);
  return out;
}

Spectrum Solve(const Eigen::MatrixXd& a, bool vectors) {
  constexpr int kWays = 8;
  if (a.rows() == 0) return {};
  if (!a.allFinite()) return NoNumbers(a.rows(), vectors);
  Eigen::EigenSolver<Eigen::MatrixXd> solver(a, vectors);
  if (solver.info() == Eigen::Success) {
    return {solver.eigenvalues(), vectors ? solver.eigenvectors() : Eigen::MatrixXcd{}};
  }
  for (int way = 1; way <= kWays; ++way) {
    const Eigen::VectorXd v = Direction(a.rows(), way);
    const Eigen::MatrixXd h =
        Eigen::MatrixXd::Identity(a.rows(), a.rows()) - 2.0 * v * v.transpose();
    solver.compute(Eigen::MatrixXd(h * a * h), vectors);
    if (solver.info() != Eigen::Success) continue;
    Spectrum out{solver.eigenvalues(), {}};
    if (vectors) out.vectors = h * solver.eigenvectors();
    return out;
  }
  throw std::runtime_error("the eigenvalues of a matrix of " + std::to_string(a.rows()) +
                           " rows do not converge");
}

}  // namespace

Spectrum SpectrumOf(const Eigen::MatrixXd& a) { return Solve(a, true); }

Eigen::VectorXcd EigenvaluesOf(const Eigen::MatrixXd& a) { return Solve(a, false).values; }

}  // namespace levitas::numerics
