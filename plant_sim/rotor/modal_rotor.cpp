#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "numerics/dense/eigenvalues.hpp"
#include "plant_sim/rotor/finite_element.hpp"

namespace levitas::rotor {
namespace {

// Free rotor: translation, and rotation about the centre of mass, mass-normalised, (11). Computed
// directly because the solver would return an arbitrary mixture at frequencies of +- 1e-3 Hz.
Eigen::MatrixXd RigidModes(const FiniteElementModel& model) {
  const auto nodes = static_cast<Eigen::Index>(model.node_z_m.size());
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(2 * nodes, 2);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    rigid(2 * i, 0) = 1.0;
    rigid(2 * i, 1) = model.node_z_m[static_cast<std::size_t>(i)];
    rigid(2 * i + 1, 1) = 1.0;
  }
  const Eigen::VectorXd momentum = model.mass * rigid.col(0);
  rigid.col(0) /= std::sqrt(momentum.dot(rigid.col(0)));
  const Eigen::VectorXd weighted = model.mass * rigid.col(0);
  rigid.col(1) -= rigid.col(0) * weighted.dot(rigid.col(1));
  rigid.col(1) /= std::sqrt(rigid.col(1).dot(model.mass * rigid.col(1)));
  return rigid;
}

struct Modes {
  Eigen::VectorXd frequency_rad_per_s;
  Eigen::MatrixXd vectors;
};

// All modes at standstill, ascending, mass-normalised; the two rigid ones exact.
Modes StandstillModes(const FiniteElementModel& model) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(model.stiffness,
                                                                         model.mass);
  if (solver.info() != Eigen::Success) {
    throw std::invalid_argument("rotor: the mass matrix is not positive definite");
  }
  Modes modes{solver.eigenvalues().cwiseMax(0.0).cwiseSqrt(), solver.eigenvectors()};
  modes.frequency_rad_per_s.head(2).setZero();
  modes.vectors.leftCols(2) = RigidModes(model);
  return modes;
}

// The rigid modes span translation and slope; that relation, inverted at both shaft ends.
Eigen::MatrixX2d RigidCoordinates(const ModalRotor& modal) {
  const Eigen::Index last = modal.shapes.rows() - 1;
  Eigen::Matrix2d ends;
  ends << modal.shapes(0, 0), modal.shapes(0, 1), modal.shapes(last, 0), modal.shapes(last, 1);
  Eigen::Matrix2d wanted;
  wanted << 1.0, modal.node_z_m.front(), 1.0, modal.node_z_m.back();
  Eigen::MatrixX2d rigid = Eigen::MatrixX2d::Zero(modal.shapes.cols(), 2);
  rigid.topRows(2) = ends.inverse() * wanted;
  return rigid;
}

WhirlFrequencies Whirl(const Eigen::VectorXd& frequency_rad_per_s,
                       const Eigen::MatrixXd& gyroscopic, double speed_rad_per_s,
                       std::size_t count) {
  const Eigen::Index n = frequency_rad_per_s.size();
  // u e^{j l t}: l^2 u = w^2 u + l W G u. With (w u, l u) as unknowns the companion form is
  // symmetric, (9): real eigenvalues, and no loss of digits from w^2 of the highest modes.
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n) = frequency_rad_per_s.asDiagonal();
  companion.bottomLeftCorner(n, n) = frequency_rad_per_s.asDiagonal();
  companion.bottomRightCorner(n, n) = speed_rad_per_s * gyroscopic;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(companion);

  // A rigid body also whirls (conical mode): it is the solution without strain energy.
  WhirlFrequencies whirl;
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const double value = solver.eigenvalues()[i];
    const double strain = solver.eigenvectors().col(i).head(n).squaredNorm();
    const double kinetic = solver.eigenvectors().col(i).tail(n).squaredNorm();
    if (strain < 0.05 * kinetic || std::abs(value) < 1e-3) continue;
    auto& side = value < 0.0 ? whirl.backward_hz : whirl.forward_hz;
    side.push_back(std::abs(value) / (2.0 * std::numbers::pi));
  }
  for (auto* side : {&whirl.backward_hz, &whirl.forward_hz}) {
    std::sort(side->begin(), side->end());
    side->resize(std::min(side->size(), count));
  }
  return whirl;
}

}  // namespace

WhirlFrequencies FreeWhirl(const FiniteElementModel& model, double speed_rad_per_s,
                           std::size_t count) {
  const Modes modes = StandstillModes(model);
  return Whirl(modes.frequency_rad_per_s,
               modes.vectors.transpose() * model.gyroscopic * modes.vectors, speed_rad_per_s,
               count);
}

WhirlFrequencies FreeWhirl(const ModalRotor& modal, double speed_rad_per_s, std::size_t count) {
  return Whirl(modal.frequency_rad_per_s, modal.gyroscopic, speed_rad_per_s, count);
}

Eigen::RowVectorXd ModalRotor::ShapeAt(double z_m, std::size_t shaft) const {
  for (std::size_t i = 0; i < node_z_m.size(); ++i) {
    if ((node_shaft.empty() ? 0 : node_shaft[i]) != shaft) continue;
    if (std::abs(node_z_m[i] - z_m) <= 1e-9) return shapes.row(static_cast<Eigen::Index>(i));
  }
  throw std::invalid_argument(fmt::format("rotor: no node at z = {} m; name it as a plane", z_m));
}

ModalRotor Reduce(const FiniteElementModel& model, std::size_t modes_per_plane,
                  double modal_damping_ratio) {
  const Modes all = StandstillModes(model);
  const Eigen::Index available = all.frequency_rad_per_s.size();
  Eigen::Index kept = static_cast<Eigen::Index>(modes_per_plane);
  if (kept == 0) kept = available;
  if (kept < 2 || kept > available) {
    throw std::invalid_argument(fmt::format(
        "rotor: modes_per_plane = {}, allowed 2 to {} (two rigid modes come first), 0 = all", kept,
        available));
  }
  if (!(modal_damping_ratio >= 0.0 && modal_damping_ratio < 1.0)) {
    throw std::invalid_argument(
        fmt::format("rotor: modal_damping_ratio = {}, allowed 0 to below 1", modal_damping_ratio));
  }
  const Eigen::MatrixXd phi = all.vectors.leftCols(kept);
  ModalRotor modal;
  modal.frequency_rad_per_s = all.frequency_rad_per_s.head(kept);
  modal.damping_ratio = Eigen::VectorXd::Constant(kept, modal_damping_ratio);
  modal.damping_ratio.head(2).setZero();
  modal.gyroscopic = phi.transpose() * model.gyroscopic * phi;
  const auto nodes = static_cast<Eigen::Index>(model.node_z_m.size());
  const auto even = Eigen::seqN(Eigen::Index{0}, nodes, Eigen::Index{2});
  const auto odd = Eigen::seqN(Eigen::Index{1}, nodes, Eigen::Index{2});
  modal.shapes = phi(even, Eigen::all);
  modal.slopes = phi(odd, Eigen::all);
  modal.node_z_m = model.node_z_m;
  modal.total_mass_kg = model.total_mass_kg;
  modal.rigid = RigidCoordinates(modal);
  return modal;
}

}  // namespace levitas::rotor
