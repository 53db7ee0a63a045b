#pragma once
// Effects of the teeth: from the entries of a rig to the gears as the time step uses them.
//
// Use        Prepare once (allocates, and makes room in the train), then Apply for every set of
//            strengths (does not allocate). Strength 0 gives the nominal gears, bit for bit.
// Equations  plant_sim/gear, docs/derivations.md (G1)-(G7); the table of the effects is
//            plant_sim/effect/rows_gear.cpp.
// Thread     any; Apply writes the train alone.

#include <span>
#include <vector>

#include "plant_sim/plant/plant_parameters.hpp"
#include "plant_sim/plant/train_model.hpp"

namespace levitas::plant {

/// The gears without effects.
struct NominalGears {
  std::vector<MeshModel> meshes;
  std::vector<std::vector<gear::Harmonic>> errors;  ///< of each mesh; entries' harmonics behind
  std::vector<ShaftUnbalance> unbalance;
};

[[nodiscard]] NominalGears PrepareGears(const PlantParameters& parameters, TrainModel& train);

/// `gears.errors` is scratch: its amplitudes are rewritten.
void ApplyToGears(const PlantParameters& parameters, std::span<const double> strengths,
                  NominalGears& gears, TrainModel& train) noexcept;

}  // namespace levitas::plant
