#pragma once
// Readings of a turning rig over whole turns, for the pictures of its spectrum.
//
// Turning  of the first bearing: readings [m] and commanded control currents [A] as x + jy, one
//          number per sample, after settling.
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

struct Turning {
  std::vector<std::complex<double>> reading_m;
  std::vector<std::complex<double>> current_a;
};

[[nodiscard]] Turning Turn(const plant::PlantParameters& rig, const Motion& motion,
                           const Control& control);

}  // namespace levitas::signature
