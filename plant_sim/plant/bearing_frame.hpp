#pragma once
// A rig whose probes and coils are all wired straight, so that readings and commands of its plant
// are numbers of the bearing frame: for models that are driven with a recorded run and never meet
// wires (analysis/records/observer.hpp, diagnosis).
// Thread  any; pure.

#include <utility>

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::plant {

[[nodiscard]] inline PlantConfig InBearingFrame(PlantConfig rig) {
  rig.sensor_polarity.fill(1.0);
  rig.actuator_polarity.fill(1.0);
  return rig;
}

[[nodiscard]] inline bool IsInBearingFrame(const PlantConfig& rig) {
  for (std::size_t axis = 0; axis < 2 * rig.bearings.size(); ++axis) {
    if (rig.sensor_polarity[axis] != 1.0 || rig.actuator_polarity[axis] != 1.0) return false;
  }
  return true;
}

}  // namespace levitas::plant
