#pragma once
// Places of a rotor that must be nodes of its mesh: those where the plant puts them, so that every
// analysis works on the mesh of the simulated rig.
// Thread any; pure.

#include <vector>

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

[[nodiscard]] inline std::vector<double> PlanesOf(const plant::PlantConfig& plant) {
  std::vector<double> planes_m;
  for (const auto& bearing : plant.bearings) {
    planes_m.push_back(bearing.actuator_z_m);
    planes_m.push_back(bearing.sensor_z_m);
  }
  for (const auto& mass : plant.unbalance) planes_m.push_back(mass.z_m);
  return planes_m;
}

}  // namespace levitas::analysis
