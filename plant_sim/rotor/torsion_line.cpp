#include "plant_sim/rotor/torsion_line.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "numerics/dense/eigenvalues.hpp"
#include "plant_sim/rotor/beam_element.hpp"
#include "plant_sim/rotor/section_at.hpp"
#include "plant_sim/rotor/torsion_springs.hpp"

namespace levitas::rotor {
namespace {

// A frequency this far below the highest is a rigid rotation: rounding of a singular stiffness.
constexpr double kRigidShare = 1e-6;

ModalTorsion Solve(const Eigen::MatrixXd& inertia, const Eigen::MatrixXd& stiffness,
                   double damping_ratio) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, inertia);
  if (solver.info() != Eigen::Success) {
    throw std::invalid_argument("torsion: every inertia must be > 0");
  }
  ModalTorsion modal;
  modal.shapes = solver.eigenvectors();
  modal.frequency_rad_per_s = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  modal.damping_ratio = Eigen::VectorXd::Constant(stiffness.rows(), damping_ratio);
  const double highest = modal.frequency_rad_per_s.maxCoeff();
  for (Eigen::Index i = 0; i < modal.frequency_rad_per_s.size(); ++i) {
    if (modal.frequency_rad_per_s[i] > kRigidShare * highest) continue;
    modal.frequency_rad_per_s[i] = 0.0;
    modal.damping_ratio[i] = 0.0;
  }
  return modal;
}

void AddSpring(Eigen::MatrixXd& stiffness, Eigen::Index at, double k) {
  stiffness(at, at) += k;
  stiffness(at + 1, at + 1) += k;
  stiffness(at, at + 1) -= k;
  stiffness(at + 1, at) -= k;
}

double PolarSecondMoment(const Section& piece) {
  return std::numbers::pi / 32.0 *
         (std::pow(piece.outer_diameter_m, 4) - std::pow(piece.inner_diameter_m, 4));
}

Eigen::Index Nearest(const std::vector<double>& nodes, double z_m) {
  const auto closer = [z_m](double a, double b) { return std::abs(a - z_m) < std::abs(b - z_m); };
  return std::min_element(nodes.begin(), nodes.end(), closer) - nodes.begin();
}

}  // namespace

ModalTorsion ReduceTorsion(const Torsion& torsion) {
  const auto count = static_cast<Eigen::Index>(torsion.inertias.size());
  if (count == 0 || torsion.gear_at >= torsion.inertias.size()) {
    throw std::invalid_argument("torsion: the gear must sit on one of the inertias");
  }
  Eigen::MatrixXd inertia = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixXd stiffness = inertia;
  for (Eigen::Index i = 0; i < count; ++i) {
    const TorsionInertia& here = torsion.inertias[static_cast<std::size_t>(i)];
    inertia(i, i) = here.inertia_kg_m2;
    stiffness(i, i) += here.ground_stiffness_n_m_per_rad;
    if (i + 1 < count) AddSpring(stiffness, i, here.stiffness_n_m_per_rad);
  }
  return Solve(inertia, stiffness, torsion.damping_ratio);
}

ModalTorsion ReduceTorsion(const RotorConfig& beam, const std::vector<double>& node_z_m,
                           double damping_ratio) {
  const auto count = static_cast<Eigen::Index>(node_z_m.size());
  Eigen::MatrixXd inertia = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixXd stiffness = inertia;
  const double shear_pa = beam.material.young_pa / (2.0 * (1.0 + beam.material.poisson));
  for (Eigen::Index i = 0; i + 1 < count; ++i) {
    const double start = node_z_m[static_cast<std::size_t>(i)];
    const double length = node_z_m[static_cast<std::size_t>(i) + 1] - start;
    const double polar = PolarSecondMoment(SectionAt(beam, start + 0.5 * length));
    AddSpring(stiffness, i, shear_pa * polar / length);
    const double share = beam.material.density_kg_per_m3 * polar * length / 6.0;
    inertia.block<2, 2>(i, i) += (Eigen::Matrix2d() << 2.0, 1.0, 1.0, 2.0).finished() * share;
  }
  for (const auto& disc : beam.discs) {
    const Eigen::Index at = Nearest(node_z_m, disc.z_m);
    inertia(at, at) += disc.polar_inertia_kg_m2;
  }
  for (const auto& ring : beam.rings) {
    const Eigen::Index at = Nearest(node_z_m, ring.z_m);
    inertia(at, at) += ToDisc(ring).polar_inertia_kg_m2;
  }
  ModalTorsion modal = Solve(inertia, stiffness, damping_ratio);
  modal.node_z_m = node_z_m;
  return modal;
}

std::vector<std::string> GaugedCouplings(const std::vector<Shaft>& shafts) {
  std::vector<std::string> names;
  for (const TorsionSpring& spring : GaugedSprings(shafts)) names.push_back(spring.name);
  return names;
}

}  // namespace levitas::rotor
