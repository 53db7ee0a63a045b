#pragma once
// Geared shafts that are a little off their file: supports, teeth, transmission error, run-out.
//
// Thread  any; pure but for the generator.

#include "common/random.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::accuracy {

/// Standard deviations of what a healthy geared rig is off by.
struct TrainMismatch {
  double shaft_stiffness{0.012}, shaft_damping{0.12};
  double mesh_stiffness{0.02}, mesh_damping{0.12};
  double transmission_error_m{0.2e-6};  ///< each of x and y, per harmonic of the file
  double gear_runout_m{0.7e-6};         ///< each of x and y, per wheel
};

/// Normal, limited to two standard deviations. Nothing for a rig with one rotor.
void Spoil(plant::PlantConfig& rig, const TrainMismatch& off, Random& random);

}  // namespace levitas::accuracy
