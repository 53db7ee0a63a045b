// Modal coordinates of several shafts.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "plant_sim/plant/train_model.hpp"
#include "plant_sim/rotor/lumped_shaft.hpp"

namespace levitas::plant {
namespace {

using Index = Eigen::Index;

struct OneShaft {
  rotor::ModalRotor bending;
  rotor::ModalTorsion torsion;
};

std::vector<double> PlanesOf(const PlantConfig& config, std::size_t shaft) {
  std::vector<double> planes_m;
  for (const auto& bearing : config.bearings) {
    if (bearing.shaft != shaft) continue;
    planes_m.push_back(bearing.actuator_z_m);
    planes_m.push_back(bearing.sensor_z_m);
  }
  for (const auto& mass : config.unbalance) {
    if (mass.shaft == shaft) planes_m.push_back(mass.z_m);
  }
  for (const auto& support : config.shafts[shaft].supports) planes_m.push_back(support.z_m);
  for (const auto& pair : config.gears) {
    if (pair.driving.shaft == shaft) planes_m.push_back(pair.driving.z_m);
    if (pair.driven.shaft == shaft) planes_m.push_back(pair.driven.z_m);
  }
  return planes_m;
}

OneShaft ReduceShaft(const PlantConfig& config, std::size_t index) {
  const rotor::Shaft& shaft = config.shafts[index];
  OneShaft one;
  if (shaft.is_beam) {
    const auto model = rotor::Assemble(shaft.beam, PlanesOf(config, index));
    one.bending = rotor::Reduce(model, shaft.beam.modes_per_plane, shaft.beam.modal_damping_ratio);
  } else {
    one.bending = rotor::Reduce(shaft.lumped);
  }
  if (shaft.torsion.kind == rotor::TorsionKind::kInertias) {
    one.torsion = rotor::ReduceTorsion(shaft.torsion);
  } else if (shaft.torsion.kind == rotor::TorsionKind::kBeam) {
    if (!shaft.is_beam) throw std::invalid_argument("torsion of a beam needs a beam");
    one.torsion =
        rotor::ReduceTorsion(shaft.beam, one.bending.node_z_m, shaft.torsion.damping_ratio);
  }
  return one;
}

void Append(Eigen::VectorXd& all, const Eigen::VectorXd& more) {
  const Index before = all.size();
  all.conservativeResize(before + more.size());
  all.tail(more.size()) = more;
}

/// Block diagonal.
void Append(Eigen::MatrixXd& all, const Eigen::MatrixXd& more) {
  Eigen::MatrixXd joined =
      Eigen::MatrixXd::Zero(all.rows() + more.rows(), all.cols() + more.cols());
  joined.topLeftCorner(all.rows(), all.cols()) = all;
  joined.bottomRightCorner(more.rows(), more.cols()) = more;
  all = std::move(joined);
}

}  // namespace

std::vector<double> SpeedRatios(const PlantConfig& config) {
  std::vector<double> ratio(config.shafts.size(), 0.0);
  if (ratio.empty()) return ratio;
  ratio[0] = 1.0;
  // Pairs may come in any order: as many rounds as there are shafts reach every one.
  for (std::size_t round = 1; round < config.shafts.size(); ++round) {
    for (const auto& pair : config.gears) {
      if (ratio[pair.driving.shaft] == 0.0 || ratio[pair.driven.shaft] != 0.0) continue;
      ratio[pair.driven.shaft] =
          -ratio[pair.driving.shaft] * pair.driving.teeth / pair.driven.teeth;
    }
  }
  for (std::size_t s = 0; s < ratio.size(); ++s) {
    if (ratio[s] != 0.0) continue;
    throw std::invalid_argument(
        fmt::format("shaft {}: no gear turns it; couple it to the first shaft", s + 1));
  }
  return ratio;
}

TrainModes ReduceTrain(const PlantConfig& config) {
  TrainModes all;
  const std::vector<double> ratio = SpeedRatios(config);
  for (std::size_t s = 0; s < config.shafts.size(); ++s) {
    const OneShaft one = ReduceShaft(config, s);
    Append(all.bending.frequency_rad_per_s, one.bending.frequency_rad_per_s);
    Append(all.bending.damping_ratio, one.bending.damping_ratio);
    Append(all.bending.gyroscopic, ratio[s] * one.bending.gyroscopic);
    Append(all.bending.shapes, one.bending.shapes);
    Append(all.bending.slopes, one.bending.slopes);
    all.bending.node_z_m.insert(all.bending.node_z_m.end(), one.bending.node_z_m.begin(),
                                one.bending.node_z_m.end());
    all.bending.node_shaft.resize(all.bending.node_z_m.size(), s);
    all.bending.total_mass_kg += one.bending.total_mass_kg;
    all.first_torsion_row.push_back(all.torsion.shapes.rows());
    Append(all.torsion.frequency_rad_per_s, one.torsion.frequency_rad_per_s);
    Append(all.torsion.damping_ratio, one.torsion.damping_ratio);
    Append(all.torsion.shapes, one.torsion.shapes);
    all.torsion.node_z_m.insert(all.torsion.node_z_m.end(), one.torsion.node_z_m.begin(),
                                one.torsion.node_z_m.end());
  }
  return all;
}

}  // namespace levitas::plant
