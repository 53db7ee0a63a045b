#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "plant_sim/rotor/finite_element.hpp"

namespace levitas::rotor {
namespace {

using Index = Eigen::Index;

constexpr double kSamePlaneM = 1e-9;

// `low` <= value, finite; a comparison with NaN fails, so it is refused too.
void AtLeast(double low, double value, const char* name) {
  if (value >= low && std::isfinite(value)) return;
  throw std::invalid_argument(
      fmt::format("rotor: {} = {}, allowed from {} on; correct the rig", name, value, low));
}

void Check(const GivenRotor& rotor) {
  constexpr double kPositive = std::numeric_limits<double>::min();
  AtLeast(kPositive, rotor.mass_kg, "mass_kg");
  AtLeast(0.0, rotor.transverse_inertia_kg_m2, "transverse_inertia_kg_m2");
  AtLeast(0.0, rotor.polar_inertia_kg_m2, "polar_inertia_kg_m2");
  AtLeast(-std::numeric_limits<double>::max(), rotor.centre_z_m, "centre_z_m");
  for (const GivenMode& mode : rotor.modes) {
    AtLeast(kPositive, mode.frequency_hz, "frequency_hz of a mode");
    AtLeast(kPositive, mode.modal_mass_kg, "modal_mass_kg of a mode");
    AtLeast(0.0, mode.damping_ratio, "damping_ratio of a mode");
    if (mode.shape.empty())
      throw std::invalid_argument("rotor: a mode without points of its shape");
  }
  for (const GyroscopicEntry& entry : rotor.gyroscopic) {
    if (entry.row == 0 || entry.row > rotor.modes.size() || entry.column > entry.row) {
      throw std::invalid_argument(fmt::format(
          "rotor: gyroscopic row = {}, column = {}: rows are 1 to {} (a mode), columns 0 "
          "to the row; correct the rig",
          entry.row, entry.column, rotor.modes.size()));
    }
    if (!std::isfinite(entry.ratio)) {
      throw std::invalid_argument("rotor: a gyroscopic ratio is not finite; correct the rig");
    }
  }
}

// The matrix of a rotor that cannot tilt has no row for it.
void AddGyroscopic(const GivenRotor& rotor, ModalRotor& modal) {
  const Index first = modal.rigid_modes - 1;  // where the tilt stands, or would stand
  for (const GyroscopicEntry& entry : rotor.gyroscopic) {
    const Index row = first + static_cast<Index>(entry.row);
    const Index column = first + static_cast<Index>(entry.column);
    if (entry.column == 0 && modal.rigid_modes < 2) continue;
    modal.gyroscopic(row, column) = modal.gyroscopic(column, row) = entry.ratio;
  }
}

struct DeflectionAndSlope {
  double deflection{};
  double slope_1_per_m{};
};

// Straight between the points; beyond the outermost ones the shape goes on as the last piece does.
DeflectionAndSlope ShapeOf(const GivenMode& mode, double z_m) {
  const auto& shape = mode.shape;
  if (shape.size() == 1) return {shape.front().deflection, 0.0};
  std::size_t right = 1;
  while (right + 1 < shape.size() && shape[right].z_m < z_m) ++right;
  const ShapePoint& a = shape[right - 1];
  const ShapePoint& b = shape[right];
  if (!(b.z_m > a.z_m)) throw std::invalid_argument("rotor: points of a shape must ascend in z");
  const double slope = (b.deflection - a.deflection) / (b.z_m - a.z_m);
  return {a.deflection + slope * (z_m - a.z_m), slope};
}

std::vector<double> Distinct(std::vector<double> planes_m) {
  std::sort(planes_m.begin(), planes_m.end());
  const auto same = [](double a, double b) { return std::abs(a - b) <= kSamePlaneM; };
  planes_m.erase(std::unique(planes_m.begin(), planes_m.end(), same), planes_m.end());
  return planes_m;
}

// Translation, and tilt about the centre of mass.
void AddRigidBody(const GivenRotor& rotor, ModalRotor& modal) {
  const double root_mass = std::sqrt(rotor.mass_kg);
  modal.shapes.col(0).setConstant(1.0 / root_mass);
  modal.rigid(0, 0) = root_mass;
  modal.rigid(0, 1) = rotor.centre_z_m * root_mass;
  if (modal.rigid_modes < 2) return;
  const double root_inertia = std::sqrt(rotor.transverse_inertia_kg_m2);
  for (Index i = 0; i < modal.shapes.rows(); ++i) {
    modal.shapes(i, 1) =
        (modal.node_z_m[static_cast<std::size_t>(i)] - rotor.centre_z_m) / root_inertia;
  }
  modal.slopes.col(1).setConstant(1.0 / root_inertia);
  modal.gyroscopic(1, 1) = rotor.polar_inertia_kg_m2 / rotor.transverse_inertia_kg_m2;
  modal.rigid(1, 1) = root_inertia;
}

}  // namespace

ModalRotor FromGivenModes(const GivenRotor& rotor, std::vector<double> planes_m) {
  Check(rotor);
  ModalRotor modal;
  modal.node_z_m = Distinct(std::move(planes_m));
  modal.total_mass_kg = rotor.mass_kg;
  modal.rigid_modes = rotor.transverse_inertia_kg_m2 > 0.0 ? 2 : 1;
  const auto nodes = static_cast<Index>(modal.node_z_m.size());
  const Index count = modal.rigid_modes + static_cast<Index>(rotor.modes.size());
  modal.frequency_rad_per_s = Eigen::VectorXd::Zero(count);
  modal.damping_ratio = Eigen::VectorXd::Zero(count);
  modal.gyroscopic = Eigen::MatrixXd::Zero(count, count);
  modal.shapes = Eigen::MatrixXd::Zero(nodes, count);
  modal.slopes = Eigen::MatrixXd::Zero(nodes, count);
  modal.rigid = Eigen::MatrixX2d::Zero(count, 2);
  AddRigidBody(rotor, modal);
  for (std::size_t k = 0; k < rotor.modes.size(); ++k) {
    const GivenMode& mode = rotor.modes[k];
    const Index at = modal.rigid_modes + static_cast<Index>(k);
    const double scale = 1.0 / std::sqrt(mode.modal_mass_kg);
    modal.frequency_rad_per_s[at] = 2.0 * std::numbers::pi * mode.frequency_hz;
    modal.damping_ratio[at] = mode.damping_ratio;
    for (Index i = 0; i < nodes; ++i) {
      const auto shape = ShapeOf(mode, modal.node_z_m[static_cast<std::size_t>(i)]);
      modal.shapes(i, at) = scale * shape.deflection;
      modal.slopes(i, at) = scale * shape.slope_1_per_m;
    }
  }
  AddGyroscopic(rotor, modal);
  return modal;
}

}  // namespace levitas::rotor
