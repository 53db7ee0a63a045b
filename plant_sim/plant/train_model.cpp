#include "plant_sim/plant/train_model.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numerics/dense/factorisations.hpp"
#include "plant_sim/gear/repeat.hpp"
#include "plant_sim/plant/eigen_index.hpp"

namespace levitas::plant {
namespace {

using Index = Eigen::Index;

// A mode without stiffness of its own takes part in a placement as if it had this little.
constexpr double kFreeModeRadPerS = 1.0;

Eigen::RowVectorXd TwistAt(const PlantConfig& config, const TrainModes& modes,
                           const gear::Wheel& wheel) {
  const rotor::Torsion& torsion = config.shafts[wheel.shaft].torsion;
  Index row = modes.first_torsion_row[wheel.shaft];
  if (torsion.kind == rotor::TorsionKind::kNone) {
    return Eigen::RowVectorXd::Zero(modes.torsion.frequency_rad_per_s.size());
  }
  if (torsion.kind == rotor::TorsionKind::kInertias) {
    row += static_cast<Index>(torsion.gear_at);
  } else {
    // A beam's torsion has a row per node of its bending model, in the same order.
    std::size_t node = 0;
    while (modes.bending.node_shaft[node] != wheel.shaft) ++node;
    while (std::abs(modes.bending.node_z_m[node] - wheel.z_m) > 1e-9) {
      ++node;
      ++row;
    }
  }
  return modes.torsion.shapes.row(row);
}

gear::MeshLaw LawOf(const gear::GearPair& pair) {
  gear::MeshLaw law;
  law.direction = pair.direction;
  law.normal = gear::LineOfAction(pair.pressure_angle_rad);
  law.stiffness_n_per_m = pair.stiffness_n_per_m;
  law.damping_n_s_per_m = pair.damping_n_s_per_m;
  if (pair.driving_torque_n_m > 0.0) {
    if (!(pair.driving.base_radius_m > 0.0)) {
      throw std::invalid_argument(
          fmt::format("gear {}: a torque needs the base radius of the driving wheel", pair.name));
    }
    law.preload_n = pair.driving_torque_n_m / pair.driving.base_radius_m;
  }
  law.half_backlash_m = 0.5 * pair.imperfection.backlash_m;
  law.friction = pair.imperfection.friction;
  law.variation = pair.imperfection.variation;
  law.cracks = pair.imperfection.cracks;
  law.driving_teeth = pair.driving.teeth;
  law.driven_teeth = pair.driven.teeth;
  return law;
}

MeshModel MeshOf(const PlantConfig& config, const TrainModes& modes,
                 const std::vector<double>& ratio, const gear::GearPair& pair) {
  MeshModel mesh;
  mesh.law = LawOf(pair);
  mesh.error = gear::TransmissionError(pair.transmission_error);
  const auto wheel = [&](const gear::Wheel& w) {
    return WheelModel{
        w.shaft,
        ratio[w.shaft],
        {w.runout_m * std::cos(w.runout_phase_rad), w.runout_m * std::sin(w.runout_phase_rad)}};
  };
  mesh.driving = wheel(pair.driving);
  mesh.driven = wheel(pair.driven);
  const Eigen::RowVectorXd driving = modes.bending.ShapeAt(pair.driving.z_m, pair.driving.shaft);
  const Eigen::RowVectorXd driven = modes.bending.ShapeAt(pair.driven.z_m, pair.driven.shaft);
  mesh.driving_shape = ToVector(driving);
  mesh.driven_shape = ToVector(driven);
  mesh.shape = ToVector(driving - driven);
  mesh.twist = ToVector(pair.driving.base_radius_m * TwistAt(config, modes, pair.driving) +
                        pair.driven.base_radius_m * TwistAt(config, modes, pair.driven));
  return mesh;
}

void AddUnbalance(TrainModel& train, const TrainModes& modes, std::size_t shaft, double z_m,
                  double moment_kg_m, double phase_rad) {
  const auto shape = ToVector(modes.bending.ShapeAt(z_m, shaft));
  for (std::size_t i = 0; i < shape.size(); ++i) {
    train.unbalance[shaft].real[i] += shape[i] * moment_kg_m * std::cos(phase_rad);
    train.unbalance[shaft].imaginary[i] += shape[i] * moment_kg_m * std::sin(phase_rad);
  }
}

void BuildUnbalance(TrainModel& train, const PlantConfig& config, const TrainModes& modes) {
  const auto count = static_cast<std::size_t>(modes.bending.frequency_rad_per_s.size());
  for (const double ratio : train.ratio) {
    train.unbalance.push_back(
        {ratio, std::vector<double>(count, 0.0), std::vector<double>(count, 0.0)});
  }
  for (const auto& mass : config.unbalance) {
    AddUnbalance(train, modes, mass.shaft, mass.z_m, mass.moment_kg_m, mass.phase_rad);
  }
  for (const auto& pair : config.gears) {
    for (const gear::Wheel* wheel : {&pair.driving, &pair.driven}) {
      AddUnbalance(train, modes, wheel->shaft, wheel->z_m,
                   wheel->eccentric_mass_kg * wheel->runout_m, wheel->runout_phase_rad);
    }
  }
}

void BuildSupports(TrainModel& train, const PlantConfig& config, const TrainModes& modes) {
  for (std::size_t s = 0; s < config.shafts.size(); ++s) {
    const rotor::Shaft& shaft = config.shafts[s];
    const auto add = [&](const rotor::Support& support) {
      train.supports.push_back({ToVector(modes.bending.ShapeAt(support.z_m, s)),
                                support.stiffness_x_n_per_m, support.stiffness_y_n_per_m,
                                support.damping_x_n_s_per_m, support.damping_y_n_s_per_m});
    };
    if (!shaft.is_beam && shaft.lumped.damping_n_s_per_m > 0.0) {
      const double c = shaft.lumped.damping_n_s_per_m;
      add({shaft.lumped.z_m, 0.0, 0.0, c, c});
    }
    for (const auto& support : shaft.supports) add(support);
    for (std::size_t i = 0; i < shaft.torsion.inertias.size(); ++i) {
      const double damping = shaft.torsion.inertias[i].ground_damping_n_m_s_per_rad;
      if (shaft.torsion.kind != rotor::TorsionKind::kInertias || damping == 0.0) continue;
      const Index row = modes.first_torsion_row[s] + static_cast<Index>(i);
      train.dampers.push_back({ToVector(modes.torsion.shapes.row(row)), damping});
    }
  }
}

void BuildInertias(TrainModel& train, const PlantConfig& config, const TrainModes& modes) {
  for (std::size_t s = 0; s < config.shafts.size(); ++s) {
    const rotor::Torsion& torsion = config.shafts[s].torsion;
    if (torsion.kind != rotor::TorsionKind::kInertias) continue;
    for (std::size_t i = 0; i < torsion.inertias.size(); ++i) {
      const Index row = modes.first_torsion_row[s] + static_cast<Index>(i);
      train.inertias.push_back({torsion.inertias[i].name, ToVector(modes.torsion.shapes.row(row))});
    }
  }
}

void BuildPlacement(TrainModel& train, const PlantConfig& config, const TrainModes& modes) {
  const Eigen::VectorXd stiffness =
      modes.bending.frequency_rad_per_s.cwiseMax(kFreeModeRadPerS).cwiseAbs2();
  const auto bearings = static_cast<Index>(config.bearings.size());
  train.placement = Eigen::MatrixXd::Zero(stiffness.size(), bearings);
  if (bearings == 0) return;
  Eigen::MatrixXd shapes(bearings, stiffness.size());
  for (Index b = 0; b < bearings; ++b) {
    const BearingConfig& bearing = config.bearings[static_cast<std::size_t>(b)];
    shapes.row(b) = modes.bending.ShapeAt(bearing.actuator_z_m, bearing.shaft);
  }
  // Least strain q^T L q under S q = places: q = L^-1 S^T (S L^-1 S^T)^-1 places.
  const Eigen::MatrixXd flexible = stiffness.cwiseInverse().asDiagonal() * shapes.transpose();
  train.placement = flexible * (shapes * flexible).inverse();
}

}  // namespace

TrainModel BuildTrain(const PlantConfig& config, const TrainModes& modes) {
  TrainModel train;
  train.shafts = config.shafts.size();
  if (train.shafts == 0) return train;
  train.twists = static_cast<std::size_t>(modes.torsion.frequency_rad_per_s.size());
  train.ratio = SpeedRatios(config);
  for (const auto& pair : config.gears) {
    train.turns_per_repeat *= gear::TurnsPerRepeat(pair);
    train.meshes.push_back(MeshOf(config, modes, train.ratio, pair));
  }
  BuildUnbalance(train, config, modes);
  BuildSupports(train, config, modes);
  BuildInertias(train, config, modes);
  BuildPlacement(train, config, modes);
  return train;
}

}  // namespace levitas::plant
