#include "design/synthesis/order_reduction.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/problem.hpp"
#include "design/synthesis/matrix_sign.hpp"
#include "design/synthesis/riccati.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/factors/factors.hpp"
#include "numerics/factors/orthogonal_columns.hpp"
#include "numerics/spectra/spectra.hpp"

namespace levitas::synthesis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

[[noreturn]] void RefuseOrder(const std::string& text) { throw Problem(ExitStatus::kOther, text); }

/// Orthonormal basis of the range of a projection of known rank.
MatrixXd RangeOf(const MatrixXd& projection, Index rank) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(projection);
  return numerics::OrthogonalColumns(qr, rank);
}

/// L with L L' = gramian; what rounding made negative is zero.
MatrixXd FactorOf(const MatrixXd& gramian) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(gramian);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

StateSpace WithoutStates(const StateSpace& system) {
  return Gain(MatrixXd::Zero(system.outputs(), system.inputs()));
}

}  // namespace

SplitSystem SplitStable(const StateSpace& given) {
  CheckShapes(given);
  const StateSpace system = Balanced(given);
  const Index n = system.states();
  const Eigen::VectorXcd poles = Poles(system);
  // Integrators stay with what does not decay: poles within rounding of the axis count as on it.
  const double shift = 1e-10 * system.A.norm();
  const Index stable = (poles.real().array() < -shift).count();
  if (n == 0 || stable == n) return {system, WithoutStates(system)};
  const MatrixXd one = MatrixXd::Identity(n, n);
  const auto sign = MatrixSign(system.A + shift * one);
  if (!sign) RefuseOrder("the controller's decaying and growing modes cannot be told apart");
  MatrixXd T(n, n);
  T << RangeOf(0.5 * (one - *sign), stable), RangeOf(0.5 * (one + *sign), n - stable);
  const Eigen::PartialPivLU<MatrixXd> lu(T);
  const MatrixXd A = lu.solve(system.A * T);
  const MatrixXd B = lu.solve(system.B);
  const MatrixXd C = system.C * T;
  SplitSystem out;
  out.stable = {A.topLeftCorner(stable, stable), B.topRows(stable), C.leftCols(stable), system.D};
  out.other = {A.bottomRightCorner(n - stable, n - stable), B.bottomRows(n - stable),
               C.rightCols(n - stable), MatrixXd::Zero(system.outputs(), system.inputs())};
  return out;
}

BalancedSystem Balance(const StateSpace& system) {
  constexpr double kNothing = 1e-13;  // share of the largest Hankel value that is rounding
  SplitSystem split = SplitStable(system);
  const StateSpace& stable = split.stable;
  if (stable.states() == 0) return {stable, Eigen::VectorXd(0), std::move(split.other)};
  const auto P = SolveLyapunov(stable.A.transpose(), stable.B * stable.B.transpose());
  const auto Q = SolveLyapunov(stable.A, stable.C.transpose() * stable.C);
  if (!P || !Q)
    RefuseOrder("the controller has no gramians: a mode decays too slowly to be weighed");
  const MatrixXd reach = FactorOf(*P);
  const MatrixXd see = FactorOf(*Q);
  const Eigen::BDCSVD<MatrixXd> svd(see.transpose() * reach,
                                    Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& values = svd.singularValues();
  const Index kept = (values.array() > kNothing * values(0)).count();
  const Eigen::VectorXd root = values.head(kept).cwiseSqrt().cwiseInverse();
  const MatrixXd T = reach * svd.matrixV().leftCols(kept) * root.asDiagonal();
  const MatrixXd inverse =
      root.asDiagonal() * svd.matrixU().leftCols(kept).transpose() * see.transpose();
  StateSpace balanced{inverse * stable.A * T, inverse * stable.B, stable.C * T, stable.D};
  return {std::move(balanced), values.head(kept), std::move(split.other)};
}

StateSpace BalancedSystem::Truncated(Index wanted) const {
  const Index r = std::clamp<Index>(wanted - other.states(), 0, stable.states());
  const StateSpace part{stable.A.topLeftCorner(r, r), stable.B.topRows(r), stable.C.leftCols(r),
                        stable.D};
  return Sum(part, other);
}

ReducedController ReduceKeeping(const StateSpace& controller,
                                const std::function<double(const StateSpace&)>& criterion,
                                double allowed) {
  const BalancedSystem balanced = Balance(controller);
  Index high = balanced.states();
  ReducedController best{balanced.Truncated(high), 0.0};
  best.criterion = criterion(best.controller);
  if (!(best.criterion <= allowed))
    RefuseOrder(
        fmt::format("the controller cannot lose a state: its criterion is {:.4g} before the "
                    "reduction, allowed {:.4g}",
                    best.criterion, allowed));
  Index low = balanced.fewest() - 1;
  while (high - low > 1) {
    const Index middle = (high + low) / 2;
    StateSpace candidate = balanced.Truncated(middle);
    const double value = criterion(candidate);
    if (value <= allowed) {
      high = middle;
      best = {std::move(candidate), value};
    } else {
      low = middle;
    }
  }
  return best;
}

}  // namespace levitas::synthesis
