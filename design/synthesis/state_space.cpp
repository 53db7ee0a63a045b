#include "design/synthesis/state_space.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "common/problem.hpp"
#include "design/synthesis/linear_solve.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/spectrum.hpp"
#include "numerics/factors/factors.hpp"

namespace levitas::synthesis {

void CheckShapes(const StateSpace& system) {
  const Eigen::Index n = system.A.rows();
  if (system.A.cols() != n || system.B.rows() != n || system.C.cols() != n ||
      system.B.cols() != system.D.cols() || system.C.rows() != system.D.rows())
    throw std::invalid_argument("the matrices A, B, C, D of a model do not fit each other");
  if (!system.A.allFinite() || !system.B.allFinite() || !system.C.allFinite() ||
      !system.D.allFinite())
    throw std::invalid_argument("a model holds a number that is not finite");
}

StateSpace Gain(const Eigen::MatrixXd& gain) {
  return {Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, gain.cols()), Eigen::MatrixXd(gain.rows(), 0),
          gain};
}

StateSpace Series(const StateSpace& first, const StateSpace& second) {
  if (first.outputs() != second.inputs())
    throw std::invalid_argument("models in series: outputs of the first, inputs of the second");
  const Eigen::Index n1 = first.states();
  const Eigen::Index n2 = second.states();
  StateSpace out;
  out.A = Eigen::MatrixXd::Zero(n1 + n2, n1 + n2);
  out.A.topLeftCorner(n1, n1) = first.A;
  out.A.bottomRightCorner(n2, n2) = second.A;
  out.A.bottomLeftCorner(n2, n1) = second.B * first.C;
  out.B.resize(n1 + n2, first.inputs());
  out.B << first.B, second.B * first.D;
  out.C.resize(second.outputs(), n1 + n2);
  out.C << second.D * first.C, second.C;
  out.D = second.D * first.D;
  return out;
}

namespace {

Eigen::MatrixXd BlockDiagonal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(a.rows() + b.rows(), a.cols() + b.cols());
  out.topLeftCorner(a.rows(), a.cols()) = a;
  out.bottomRightCorner(b.rows(), b.cols()) = b;
  return out;
}

}  // namespace

StateSpace Append(const StateSpace& first, const StateSpace& second) {
  return {BlockDiagonal(first.A, second.A), BlockDiagonal(first.B, second.B),
          BlockDiagonal(first.C, second.C), BlockDiagonal(first.D, second.D)};
}

StateSpace Copies(const StateSpace& one, Eigen::Index count) {
  StateSpace out = one;
  for (Eigen::Index i = 1; i < count; ++i) out = Append(out, one);
  return out;
}

StateSpace Sum(const StateSpace& first, const StateSpace& second) {
  StateSpace out = Append(first, second);
  out.B.resize(out.states(), first.inputs());
  out.B << first.B, second.B;
  out.C.resize(first.outputs(), out.states());
  out.C << first.C, second.C;
  out.D = first.D + second.D;
  return out;
}

StateSpace Transposed(const StateSpace& system) {
  return {system.A.transpose(), system.C.transpose(), system.B.transpose(), system.D.transpose()};
}

StateSpace LowerFeedback(const StateSpace& plant, const StateSpace& controller) {
  const Eigen::Index u = controller.outputs();
  const Eigen::Index y = controller.inputs();
  const Eigen::Index w = plant.inputs() - u;
  const Eigen::Index z = plant.outputs() - y;
  if (w < 0 || z < 0)
    throw std::invalid_argument("a controller has more inputs or outputs than its plant");
  const auto B1 = plant.B.leftCols(w);
  const auto B2 = plant.B.rightCols(u);
  const auto C1 = plant.C.topRows(z);
  const auto C2 = plant.C.bottomRows(y);
  const auto D12 = plant.D.topRightCorner(z, u);
  const auto D21 = plant.D.bottomLeftCorner(y, w);
  const auto D22 = plant.D.bottomRightCorner(y, u);
  // u = Dk y + Ck xk and y = C2 x + D21 w + D22 u, solved for u: u = Q (Dk (C2 x + D21 w) + Ck xk).
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(u, u);
  const Eigen::FullPivLU<Eigen::MatrixXd> loop(one - controller.D * D22);
  if (u > 0 && !loop.isInvertible())
    throw Problem(ExitStatus::kOther,
                  "the direct gains of plant and controller form a loop without a solution");
  const Eigen::MatrixXd Q = SolveColumns(loop, one);
  const Eigen::MatrixXd from_y = Q * controller.D;  // u per (C2 x + D21 w)
  const Eigen::MatrixXd from_k = Q * controller.C;  // u per xk
  const Eigen::MatrixXd y_gain = Eigen::MatrixXd::Identity(y, y) + D22 * from_y;
  const Eigen::Index n = plant.states();
  const Eigen::Index nk = controller.states();
  StateSpace out;
  out.A.resize(n + nk, n + nk);
  out.A << plant.A + B2 * from_y * C2, B2 * from_k, controller.B * y_gain * C2,
      controller.A + controller.B * D22 * from_k;
  out.B.resize(n + nk, w);
  out.B << B1 + B2 * from_y * D21, controller.B * y_gain * D21;
  out.C.resize(z, n + nk);
  out.C << C1 + D12 * from_y * C2, D12 * from_k;
  out.D = plant.D.topLeftCorner(z, w) + D12 * from_y * D21;
  return out;
}

Eigen::MatrixXcd TransferAt(const StateSpace& system, std::complex<double> s) {
  if (system.states() == 0) return system.D.cast<std::complex<double>>();
  Eigen::MatrixXcd shifted = -system.A.cast<std::complex<double>>();
  shifted.diagonal().array() += s;
  const Eigen::MatrixXcd state =
      shifted.partialPivLu().solve(system.B.cast<std::complex<double>>());
  return system.C * state + system.D;
}

Eigen::MatrixXcd Response(const StateSpace& system, double rad_per_s) {
  if (std::isinf(rad_per_s)) return system.D.cast<std::complex<double>>();
  return TransferAt(system, {0.0, rad_per_s});
}

Eigen::VectorXcd Poles(const StateSpace& system) {
  if (system.states() == 0) return Eigen::VectorXcd(0);
  return numerics::EigenvaluesOf(system.A);
}

bool IsStable(const StateSpace& system) {
  const Eigen::VectorXcd poles = Poles(system);
  return poles.size() == 0 || poles.real().maxCoeff() < 0.0;
}

StateSpace Balanced(const StateSpace& system) {
  constexpr int kSweeps = 20;
  StateSpace out = system;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool changed = false;
    for (Eigen::Index i = 0; i < out.states(); ++i) {
      const double own = std::abs(out.A(i, i));
      const double row = out.A.row(i).cwiseAbs().sum() - own + out.B.row(i).cwiseAbs().sum();
      const double column = out.A.col(i).cwiseAbs().sum() - own + out.C.col(i).cwiseAbs().sum();
      if (!(row > 0.0) || !(column > 0.0)) continue;
      const double scale = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (scale == 1.0) continue;
      changed = true;
      out.A.row(i) /= scale;
      out.B.row(i) /= scale;
      out.A.col(i) *= scale;
      out.C.col(i) *= scale;
    }
    if (!changed) break;
  }
  return out;
}

}  // namespace levitas::synthesis
