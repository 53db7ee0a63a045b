#pragma once
// Readings of a turning rig over whole turns, for the pictures of its spectrum.
//
// Orbit    of the first bearing as x + jy [m], one number per sample, after settling.
// Control  called after each sample to set the control currents of the command; empty: none.
// Thread   any; a simulation of some seconds of the rig's time.

#include <complex>
#include <functional>
#include <vector>

#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_parameters.hpp"

namespace levitas::signature {

struct Motion {
  double speed_hz{};
  int turns{};  ///< recorded
  double settle_s{};
};

using Control = std::function<void(const SensorFrame&, plant::PlantCommand&)>;

[[nodiscard]] std::vector<std::complex<double>> Orbit(const plant::PlantParameters& rig,
                                                      const Motion& motion, const Control& control);

}  // namespace levitas::signature
