#pragma once
// The rig after modal reduction: the numbers that can be set by name (parameter_access.hpp).

#include <vector>

#include "plant_sim/plant/plant_config.hpp"
#include "plant_sim/rotor/finite_element.hpp"
#include "plant_sim/rotor/torsion_line.hpp"

namespace levitas::plant {

/// `config.rotor` only says where `modes` came from.
struct PlantParameters {
  PlantConfig config;
  rotor::ModalRotor modes;
  rotor::ModalTorsion torsion{};                  ///< of geared shafts; empty for one rotor
  std::vector<Eigen::Index> first_torsion_row{};  ///< of each shaft, in torsion.shapes
};

}  // namespace levitas::plant
