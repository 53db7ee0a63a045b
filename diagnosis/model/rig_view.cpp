#include "diagnosis/model/rig_view.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "analysis/reading_noise.hpp"
#include "analysis/records/observer.hpp"
#include "common/problem.hpp"
#include "diagnosis/model/sample_point.hpp"
#include "plant_sim/plant/bearing_frame.hpp"
#include "plant_sim/plant/plain_sensors.hpp"

namespace levitas::diagnosis {
namespace {

std::size_t NearestNode(const std::vector<double>& nodes_m, double z_m) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < nodes_m.size(); ++i) {
    if (std::abs(nodes_m[i] - z_m) < std::abs(nodes_m[best] - z_m)) best = i;
  }
  return best;
}

std::vector<double> Row(const Eigen::MatrixXd& matrix, std::size_t row) {
  std::vector<double> values(static_cast<std::size_t>(matrix.cols()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i));
  }
  return values;
}

bool ByChance(const effect::EffectConfig& entry) {
  using effect::Id;
  return entry.id == Id::kDroppedSamples || entry.id == Id::kSampleJitter ||
         entry.id == Id::kMainsPickup;
}

plant::PlantConfig Foretold(plant::PlantConfig plant) {
  std::erase_if(plant.effects, ByChance);
  return analysis::WithSpeedImposed(plant);
}

}  // namespace

RigView::RigView(const RigNumbers& rig_numbers, const plant::PlantConfig& plant)
    : numbers(rig_numbers),
      model(std::make_shared<const plant::PlantModel>(plant::InBearingFrame(Foretold(plant)))),
      axes(model->axes()),
      modes(model->layout().modes),
      period_s(static_cast<double>(plant.period_ns) * 1e-9) {
  std::copy_if(plant.effects.begin(), plant.effects.end(), std::back_inserter(by_chance), ByChance);
  if (!plant::HasPlainSensors(plant)) {
    throw BadInput(fmt::format("rig {}: a diagnosis {}", numbers.name, plant::kPlainSensorsOnly));
  }
  if (modes > kMaxModes) {
    throw BadInput(
        fmt::format("rig {} has {} modes per plane, a diagnosis takes at most {}: lower "
                    "rotor.modes_per_plane",
                    numbers.name, modes, kMaxModes));
  }
  if (model->layout().twists > 0) {
    throw BadInput(fmt::format("rig {}: shafts that twist cannot be diagnosed; leave out `torsion`",
                               numbers.name));
  }
  if (plant.gears.size() > kMostMeshes) {
    throw BadInput(fmt::format("rig {} has {} gear pairs, a diagnosis takes at most {}",
                               numbers.name, plant.gears.size(), kMostMeshes));
  }
  meshes = MeshesOf(*model);
  // With what effects of the file make of them.
  omega_rad_per_s = model->frequency();
  damping_ratio = model->damping_ratio();
}

double RigView::ReadingNoise(std::size_t axis) const {
  plant::SensorConfig sensor = bearing(axis).sensor;
  sensor.noise_rms_m = model->effects().readings[axis].noise_rms_m;
  return analysis::ReadingNoise(sensor);
}

std::vector<double> RigView::Shape(double z_m) const {
  const auto& rotor = model->parameters().modes;
  return Row(rotor.shapes, NearestNode(rotor.node_z_m, z_m));
}

double RigView::ShapeRms(std::size_t mode) const {
  const auto& shapes = model->parameters().modes.shapes;
  return std::sqrt(shapes.col(static_cast<Eigen::Index>(mode)).squaredNorm() /
                   static_cast<double>(shapes.rows()));
}

std::vector<double> RigView::Slope(double z_m) const {
  const auto& rotor = model->parameters().modes;
  return Row(rotor.slopes, NearestNode(rotor.node_z_m, z_m));
}

}  // namespace levitas::diagnosis
