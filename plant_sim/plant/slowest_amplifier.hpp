#pragma once
// The smallest bandwidth [Hz] of a rig's amplifiers; 0 when none has a limit. Thread: any; pure.

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::plant {

[[nodiscard]] inline double SlowestAmplifierHz(const PlantConfig& plant) {
  double slowest_hz = 0.0;
  for (const BearingConfig& bearing : plant.bearings) {
    const double one_hz = bearing.amplifier.bandwidth_hz;
    if (one_hz > 0.0 && (slowest_hz <= 0.0 || one_hz < slowest_hz)) slowest_hz = one_hz;
  }
  return slowest_hz;
}

}  // namespace levitas::plant
