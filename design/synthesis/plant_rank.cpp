#include "design/synthesis/plant_rank.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

#include "common/problem.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/spectrum.hpp"
#include "numerics/spectra/spectra.hpp"

namespace levitas::synthesis {

namespace {

[[noreturn]] void RefusePlant(const std::string& text) { throw Problem(ExitStatus::kOther, text); }

std::string ModeText(std::complex<double> pole) {
  return fmt::format("the mode at {:.4g} Hz (real part {:.4g} 1/s)",
                     std::abs(pole.imag()) / (2.0 * std::numbers::pi), pole.real());
}

double SmallestSingularValue(const Eigen::MatrixXcd& matrix) {
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXcd>(matrix).singularValues();
  return values(values.size() - 1);
}

/// [pole I - A, B] loses rank: the mode cannot be moved by B.
bool IsUnreachable(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, std::complex<double> pole) {
  const Eigen::Index n = A.rows();
  Eigen::MatrixXcd pencil(n, n + B.cols());
  pencil << -A.cast<std::complex<double>>(), B.cast<std::complex<double>>();
  pencil.diagonal().array() += pole;
  const double rounding = 1e-14 * static_cast<double>(n) * (A.norm() + std::abs(pole) + B.norm());
  return SmallestSingularValue(pencil) <= rounding;
}

/// Every pole that does not decay, integrators included, can be moved by B.
void CheckReachable(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const char* lead) {
  if (A.rows() == 0) return;
  const double rounding = 1e-13 * A.norm();
  const Eigen::VectorXcd poles = numerics::EigenvaluesOf(A);
  for (const auto& pole : poles)
    if (pole.imag() >= 0.0 && pole.real() >= -rounding && IsUnreachable(A, B, pole))
      RefusePlant(fmt::format("{}: {} does not decay", lead, ModeText(pole)));
}

void CheckColumns(const Eigen::MatrixXd& D12, const char* text) {
  if (D12.cols() == 0) RefusePlant("the plant has no control input or no measurement");
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(D12);
  const Eigen::VectorXd& values = svd.singularValues();
  if (D12.rows() < D12.cols() || !(values(D12.cols() - 1) > 1e-12 * values(0))) RefusePlant(text);
}

/// Zeros of (A, B, C, D) on the axis, D of full column rank: unobservable modes of
/// (A - B D^+ C, (I - D D^+) C).
void CheckAxisZeros(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C,
                    const Eigen::MatrixXd& D, const char* lead) {
  if (A.rows() == 0) return;
  const Eigen::MatrixXd inverse = D.completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::MatrixXd Az = A - B * inverse * C;
  const Eigen::MatrixXd Cz = C - D * inverse * C;
  const double rounding = 1e-12 * Az.norm();
  const Eigen::VectorXcd zeros = numerics::EigenvaluesOf(Az);
  for (const auto& zero : zeros)
    if (zero.imag() >= 0.0 && std::abs(zero.real()) <= rounding &&
        IsUnreachable(Az.transpose(), Cz.transpose(), zero))
      RefusePlant(
          fmt::format("{} at {:.4g} Hz: move the poles of the weights there off the axis, or "
                      "give the mode damping",
                      lead, zero.imag() / (2.0 * std::numbers::pi)));
}

}  // namespace

void CheckSolvable(const GeneralisedPlant& plant) {
  CheckShapes(plant.system);
  if (plant.controls < 0 || plant.measurements < 0 || plant.disturbances() < 0 ||
      plant.errors() < 0)
    throw std::invalid_argument("a generalised plant has more controls than inputs, or the like");
  const StateSpace system = Balanced(plant.system);
  const Eigen::Index w = plant.disturbances();
  const Eigen::Index z = plant.errors();
  const auto B1 = system.B.leftCols(w);
  const auto B2 = system.B.rightCols(plant.controls);
  const auto C1 = system.C.topRows(z);
  const auto C2 = system.C.bottomRows(plant.measurements);
  const auto D12 = system.D.topRightCorner(z, plant.controls);
  const auto D21 = system.D.bottomLeftCorner(plant.measurements, w);
  CheckColumns(D12,
               "the plant's D12 has not full column rank: a control current is not weighted at "
               "high frequency; give every control a weight that does not roll off to zero");
  CheckColumns(D21.transpose(),
               "the plant's D21 has not full row rank: a measurement carries no noise; give every "
               "sensor a noise weight above zero");
  CheckReachable(system.A, B2, "the plant is not stabilisable by its control inputs");
  CheckReachable(system.A.transpose(), C2.transpose(),
                 "the plant is not detectable from its measurements");
  CheckAxisZeros(system.A, B2, C1, D12,
                 "the plant from control to error has a zero on the imaginary axis");
  CheckAxisZeros(system.A.transpose(), C2.transpose(), B1.transpose(), D21.transpose(),
                 "the plant from disturbance to measurement has a zero on the imaginary axis");
}

}  // namespace levitas::synthesis
