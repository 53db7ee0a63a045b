#include "design/synthesis/hamiltonian.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "design/synthesis/linear_solve.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/spectrum.hpp"
#include "numerics/factors/factors.hpp"
#include "numerics/spectra/spectra.hpp"

namespace levitas::synthesis {

namespace {

template <class Matrix>
std::optional<Matrix> HamiltonianOf(const StateSpace& system, const Matrix& pi) {
  using Scalar = typename Matrix::Scalar;
  const Eigen::Index n = system.states();
  const Eigen::Index p = system.outputs();
  const Eigen::Index m = system.inputs();
  const Matrix A = system.A.cast<Scalar>();
  const Matrix B = system.B.cast<Scalar>();
  const Matrix C = system.C.cast<Scalar>();
  const Matrix D = system.D.cast<Scalar>();
  const Matrix pi11 = pi.topLeftCorner(p, p);
  const Matrix pi12 = pi.topRightCorner(p, m);
  const Matrix Q = C.transpose() * pi11 * C;
  const Matrix S = C.transpose() * (pi11 * D + pi12);
  const Matrix cross = D.transpose() * pi12;
  const Matrix R = D.transpose() * pi11 * D + cross + cross.adjoint() + pi.bottomRightCorner(m, m);
  const Eigen::FullPivLU<Matrix> lu(R);
  if (!lu.isInvertible()) return std::nullopt;
  Matrix left(2 * n, m);
  left << B, -S;
  Matrix right(m, 2 * n);
  right << S.adjoint(), B.transpose();
  Matrix H(2 * n, 2 * n);
  H << A, Matrix::Zero(n, n), -Q, -A.transpose();
  return H - left * SolveColumns(lu, right);
}

std::vector<double> OnTheAxis(const Eigen::VectorXcd& eigenvalues, bool both_signs) {
  constexpr double kOnAxis = 1e-7;
  std::vector<double> found;
  if (eigenvalues.size() == 0) return found;
  const double largest = eigenvalues.cwiseAbs().maxCoeff();
  for (const auto& value : eigenvalues) {
    // Rounding of an eigenvalue grows with the matrix; eigenvalues near zero have more of it.
    const double allowed = std::max(1e-5 * std::abs(value), 1e-3 * kOnAxis * largest);
    if (std::abs(value.real()) > allowed) continue;
    if (both_signs || value.imag() >= 0.0) found.push_back(value.imag());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::optional<std::vector<double>> CrossingFrequencies(const StateSpace& system,
                                                       const Eigen::MatrixXd& pi) {
  const auto H = HamiltonianOf(system, pi);
  if (!H) return std::nullopt;
  if (H->rows() == 0) return std::vector<double>{};
  return OnTheAxis(numerics::EigenvaluesOf(*H), false);
}

std::optional<std::vector<double>> CrossingFrequencies(const StateSpace& system,
                                                       const Eigen::MatrixXcd& pi) {
  const auto H = HamiltonianOf(system, pi);
  if (!H) return std::nullopt;
  if (H->rows() == 0) return std::vector<double>{};
  return OnTheAxis(Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(*H, false).eigenvalues(), true);
}

}  // namespace levitas::synthesis
