#include "analysis/rotor_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/rotor_planes.hpp"
#include "plant_sim/rotor/finite_element.hpp"

namespace levitas::analysis {
namespace {

rotor::ModalRotor ModalOf(const plant::PlantConfig& plant, std::size_t modes) {
  std::vector<double> planes_m = PlanesOf(plant);
  if (plant.rotor.given) {
    for (const auto& mode : plant.rotor.given->modes) {
      for (const auto& point : mode.shape) planes_m.push_back(point.z_m);
    }
    return rotor::FromGivenModes(*plant.rotor.given, planes_m);
  }
  const auto model = rotor::Assemble(plant.rotor, planes_m);
  constexpr std::size_t kRigid = 2;
  const std::size_t kept = std::min(modes + kRigid, 2 * model.node_z_m.size());
  return rotor::Reduce(model, kept, plant.rotor.modal_damping_ratio);
}

ModeShape ShapeOf(const rotor::ModalRotor& modal, Eigen::Index mode) {
  ModeShape shape;
  shape.frequency_hz = modal.frequency_rad_per_s[mode] / (2.0 * std::numbers::pi);
  Eigen::Index largest = 0;
  modal.shapes.col(mode).cwiseAbs().maxCoeff(&largest);
  const double scale = modal.shapes(largest, mode);
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < modal.node_z_m.size(); ++i) {
    points.emplace_back(modal.node_z_m[i],
                        modal.shapes(static_cast<Eigen::Index>(i), mode) / scale);
  }
  std::sort(points.begin(), points.end());
  for (const auto& [z_m, deflection] : points) {
    shape.z_m.push_back(z_m);
    shape.deflection.push_back(deflection);
  }
  return shape;
}

std::vector<StaticLoad> LoadsOf(const plant::PlantConfig& plant, double weight_n,
                                double centre_z_m) {
  std::vector<StaticLoad> loads;
  for (const auto& bearing : plant.bearings) {
    loads.push_back({bearing.name, bearing.actuator_z_m, std::nullopt});
  }
  if (loads.size() == 1) loads[0].load_n = weight_n;
  if (loads.size() == 2 && loads[0].z_m != loads[1].z_m) {
    const double share = (loads[1].z_m - centre_z_m) / (loads[1].z_m - loads[0].z_m);
    loads[0].load_n = weight_n * share;
    loads[1].load_n = weight_n * (1.0 - share);
  }
  return loads;
}

}  // namespace

RotorFigures FiguresOf(const plant::PlantConfig& plant, std::size_t modes) {
  if (!plant.shafts.empty()) {
    throw std::invalid_argument("rotor figures: the rig has several shafts, not one rotor");
  }
  const rotor::ModalRotor modal = ModalOf(plant, modes);
  const Eigen::VectorXd shift = modal.rigid.col(0);
  const Eigen::VectorXd slope = modal.rigid.col(1);
  RotorFigures figures;
  figures.mass_kg = shift.squaredNorm();
  figures.centre_z_m = shift.dot(slope) / figures.mass_kg;
  figures.transverse_inertia_kg_m2 = std::max(
      0.0, slope.squaredNorm() - figures.mass_kg * figures.centre_z_m * figures.centre_z_m);
  figures.polar_inertia_kg_m2 = slope.dot(modal.gyroscopic * slope);
  figures.loads = LoadsOf(plant, figures.mass_kg * plant.gravity_m_per_s2, figures.centre_z_m);
  const Eigen::Index last =
      std::min(modal.shapes.cols(), modal.rigid_modes + static_cast<Eigen::Index>(modes));
  for (Eigen::Index mode = modal.rigid_modes; mode < last; ++mode) {
    figures.shapes.push_back(ShapeOf(modal, mode));
  }
  return figures;
}

}  // namespace levitas::analysis
