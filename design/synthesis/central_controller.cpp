#include "design/synthesis/central_controller.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "design/synthesis/linear_solve.hpp"
#include "design/synthesis/riccati.hpp"
#include "design/synthesis/singular_value.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/spectrum.hpp"
#include "numerics/factors/factors.hpp"
#include "numerics/spectra/spectra.hpp"

namespace levitas::synthesis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

std::optional<Half> SolveHalf(const MatrixXd& A, const MatrixXd& B1, const MatrixXd& B2,
                              const MatrixXd& C1, const MatrixXd& D11, const MatrixXd& D12,
                              double gamma) {
  const Index w = B1.cols();
  MatrixXd B(B1.rows(), w + B2.cols());
  B << B1, B2;
  MatrixXd D(D11.rows(), B.cols());
  D << D11, D12;
  MatrixXd R = D.transpose() * D;
  R.topLeftCorner(w, w).diagonal().array() -= gamma * gamma;
  const Eigen::FullPivLU<MatrixXd> lu(R);
  if (!lu.isInvertible()) return std::nullopt;
  const MatrixXd cross = D.transpose() * C1;
  const MatrixXd Ax = A - B * SolveColumns(lu, cross);
  const MatrixXd G = B * SolveColumns(lu, B.transpose());
  const MatrixXd Q = C1.transpose() * C1 - cross.transpose() * SolveColumns(lu, cross);
  auto X = SolveRiccati(Ax, 0.5 * (G + G.transpose()), 0.5 * (Q + Q.transpose()),
                        (C1.transpose() * C1).norm());
  if (!X) return std::nullopt;
  return Half{*X, -SolveColumns(lu, cross + B.transpose() * *X)};
}

bool IsNonNegative(const MatrixXd& X) {
  if (X.rows() == 0) return true;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(X, Eigen::EigenvaluesOnly);
  const auto& values = solver.eigenvalues();
  // Modes that are not seen leave eigenvalues of zero, rounded.
  return values(0) >= -1e-7 * std::max(std::abs(values(values.size() - 1)), 1e-300);
}

/// Undoes the scaling of u and y, and the removal of D22.
StateSpace InUnitsOfThePlant(const NormalPlant& plant, StateSpace k) {
  k.B = k.B * plant.to_measurement;
  k.C = plant.from_control * k.C;
  k.D = plant.from_control * k.D * plant.to_measurement;
  if (plant.D22.isZero(0.0)) return k;
  // y - D22 u is what the controller was made for.
  const Index u = k.D.rows();
  const Eigen::FullPivLU<MatrixXd> loop(MatrixXd::Identity(u, u) + k.D * plant.D22);
  const MatrixXd from_state = SolveColumns(loop, k.C);
  const MatrixXd from_y = SolveColumns(loop, k.D);
  StateSpace out;
  out.A = k.A - k.B * plant.D22 * from_state;
  out.B = k.B - k.B * plant.D22 * from_y;
  out.C = from_state;
  out.D = from_y;
  return out;
}

/// What passes straight through the controllers of theorem 17.1; hats of the book are dropped.
struct Feedthrough {
  MatrixXd D11, D12, D21;
};

Feedthrough FeedthroughOf(const NormalPlant& plant, double gamma) {
  const Index u = plant.B2.cols();
  const Index y = plant.C2.rows();
  const Index z1 = plant.D11.rows() - u;
  const Index w1 = plant.D11.cols() - y;
  const double g2 = gamma * gamma;
  const MatrixXd D1111 = plant.D11.topLeftCorner(z1, w1);
  const MatrixXd D1112 = plant.D11.topRightCorner(z1, y);
  const MatrixXd D1121 = plant.D11.bottomLeftCorner(u, w1);
  const MatrixXd D1122 = plant.D11.bottomRightCorner(u, y);
  const MatrixXd over_z = g2 * MatrixXd::Identity(z1, z1) - D1111 * D1111.transpose();
  const MatrixXd over_w = g2 * MatrixXd::Identity(w1, w1) - D1111.transpose() * D1111;
  const Eigen::LDLT<MatrixXd> by_z(over_z);
  const Eigen::LDLT<MatrixXd> by_w(over_w);
  MatrixXd D11 = -D1122;
  MatrixXd square12 = MatrixXd::Identity(u, u);
  MatrixXd square21 = MatrixXd::Identity(y, y);
  if (z1 > 0) square21 -= D1112.transpose() * by_z.solve(D1112);
  if (w1 > 0) square12 -= D1121 * by_w.solve(D1121.transpose());
  if (z1 > 0 && w1 > 0) D11 -= D1121 * D1111.transpose() * by_z.solve(D1112);
  return {D11, square12.llt().matrixL(), square21.llt().matrixU()};
}

/// Theorem 17.1: every controller that meets gamma is this system with a stable parameter of norm
/// below gamma closed round its last inputs and outputs. Hats of the book are dropped.
StateSpace AllControllers(const NormalPlant& plant, const Solved& solved, double gamma) {
  const Index u = plant.B2.cols();
  const Index y = plant.C2.rows();
  const Index z1 = plant.D11.rows() - u;
  const Index w1 = plant.D11.cols() - y;
  const double g2 = gamma * gamma;
  const auto [D11, D12, D21] = FeedthroughOf(plant, gamma);
  const MatrixXd& F = solved.regulator.gain;
  const MatrixXd L = solved.filter.gain.transpose();
  const MatrixXd F12 = F.middleRows(w1, y);
  const MatrixXd F2 = F.bottomRows(u);
  const MatrixXd L12 = L.middleCols(z1, u);
  const MatrixXd L2 = L.rightCols(y);
  const Index n = plant.A.rows();
  const Eigen::PartialPivLU<MatrixXd> Z(MatrixXd::Identity(n, n) -
                                        solved.filter.solution * solved.regulator.solution / g2);
  const MatrixXd C2 = -D21 * (plant.C2 + F12);
  const MatrixXd by12 = D12.triangularView<Eigen::Lower>().solve(D11);  // D12^-1 D11
  // D21^-1 C2; SolveColumns says why a plant without states is left out.
  const MatrixXd by21 = n > 0 ? MatrixXd(D21.triangularView<Eigen::Upper>().solve(C2)) : C2;
  MatrixXd B(n, plant.B1.cols() + u);
  B << plant.B1, plant.B2;
  const MatrixXd B2 = (plant.B2 + L12) * D12;
  const MatrixXd B1 = SolveColumns(Z, B2 * by12 - L2);
  StateSpace all;
  all.B.resize(n, y + u);
  all.B << B1, SolveColumns(Z, B2);
  all.C.resize(u + y, n);
  all.C << F2 + D11 * by21, C2;
  all.A = plant.A + B * F + B1 * by21;
  all.D = MatrixXd::Zero(u + y, y + u);
  all.D.topLeftCorner(u, y) = D11;
  all.D.topRightCorner(u, u) = D12;
  all.D.bottomLeftCorner(y, y) = D21;
  return all;
}

}  // namespace

NormalPlant Normalise(const GeneralisedPlant& plant) {
  const StateSpace system = Balanced(plant.system);
  const Index w = plant.disturbances();
  const Index z = plant.errors();
  const Index u = plant.controls;
  const Index y = plant.measurements;
  constexpr auto kFull = Eigen::ComputeFullU | Eigen::ComputeFullV;
  const Eigen::JacobiSVD<MatrixXd> svd12(system.D.topRightCorner(z, u), kFull);
  const Eigen::JacobiSVD<MatrixXd> svd21(system.D.bottomLeftCorner(y, w), kFull);
  MatrixXd errors(z, z);  // z' = errors^T z
  errors << svd12.matrixU().rightCols(z - u), svd12.matrixU().leftCols(u);
  MatrixXd disturbances(w, w);  // w = disturbances w'
  disturbances << svd21.matrixV().rightCols(w - y), svd21.matrixV().leftCols(y);
  NormalPlant out;
  out.from_control = svd12.matrixV() * svd12.singularValues().cwiseInverse().asDiagonal();
  out.to_measurement =
      svd21.singularValues().cwiseInverse().asDiagonal() * svd21.matrixU().transpose();
  out.A = system.A;
  out.B1 = system.B.leftCols(w) * disturbances;
  out.B2 = system.B.rightCols(u) * out.from_control;
  out.C1 = errors.transpose() * system.C.topRows(z);
  out.C2 = out.to_measurement * system.C.bottomRows(y);
  out.D11 = errors.transpose() * system.D.topLeftCorner(z, w) * disturbances;
  out.D22 = system.D.bottomRightCorner(y, u);
  return out;
}

double DirectLimit(const NormalPlant& plant) {
  const Index free_z = plant.D11.rows() - plant.B2.cols();
  const Index free_w = plant.D11.cols() - plant.C2.rows();
  return std::max(LargestSingularValue(plant.D11.topRows(free_z)),
                  LargestSingularValue(plant.D11.leftCols(free_w)));
}

Verdict Solve(const NormalPlant& plant, double gamma, Solved& out) {
  if (!(gamma > DirectLimit(plant))) return Verdict::kDirect;
  const Index z = plant.D11.rows();
  const Index w = plant.D11.cols();
  const Index u = plant.B2.cols();
  const Index y = plant.C2.rows();
  MatrixXd D12 = MatrixXd::Zero(z, u);
  D12.bottomRows(u).setIdentity();
  MatrixXd D21t = MatrixXd::Zero(w, y);
  D21t.bottomRows(y).setIdentity();
  auto regulator = SolveHalf(plant.A, plant.B1, plant.B2, plant.C1, plant.D11, D12, gamma);
  if (!regulator || !IsNonNegative(regulator->solution)) return Verdict::kRegulator;
  auto filter = SolveHalf(plant.A.transpose(), plant.C1.transpose(), plant.C2.transpose(),
                          plant.B1.transpose(), plant.D11.transpose(), D21t, gamma);
  if (!filter || !IsNonNegative(filter->solution)) return Verdict::kFilter;
  out = {std::move(*regulator), std::move(*filter)};
  if (plant.A.rows() == 0) return Verdict::kSolved;
  const MatrixXd product = out.regulator.solution * out.filter.solution;
  const double radius = numerics::EigenvaluesOf(product).cwiseAbs().maxCoeff();
  return radius < gamma * gamma ? Verdict::kSolved : Verdict::kCoupling;
}

const char* TextOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kSolved:
      return "solved";
    case Verdict::kDirect:
      return "the direct gain from disturbance to error alone is larger";
    case Verdict::kRegulator:
      return "control effort against error cannot do it (regulator Riccati equation)";
    case Verdict::kFilter:
      return "noise against disturbance cannot be told apart well enough (filter Riccati equation)";
    case Verdict::kCoupling:
      return "control and estimation together cannot do it (spectral radius of X Y)";
  }
  return "";
}

StateSpace Controller(const NormalPlant& plant, const Solved& solved, double gamma) {
  constexpr double kSingular = 1e-6;
  const StateSpace all = AllControllers(plant, solved, gamma);
  const Index u = plant.B2.cols();
  const Index y = plant.C2.rows();
  MatrixXd parameter = MatrixXd::Zero(u, y);
  const MatrixXd direct = plant.from_control * all.D.topLeftCorner(u, y) * plant.to_measurement;
  const MatrixXd loop = MatrixXd::Identity(u, u) + direct * plant.D22;
  const Eigen::VectorXd values = Eigen::JacobiSVD<MatrixXd>(loop).singularValues();
  if (!(values(u - 1) > kSingular * std::max(1.0, values(0))))
    parameter.diagonal().setConstant(0.5 * gamma);
  return InUnitsOfThePlant(plant, LowerFeedback(all, Gain(parameter)));
}

}  // namespace levitas::synthesis
