#pragma once
// Effects of teeth drawn at random, as hidden_effect.hpp draws those of a rotor.
//
// Size     1 is clear on `geared_rotor_4dof`. Units SI as in the catalogue. Thread: any; pure but
//          for the generator.

#include <vector>

#include "common/random.hpp"
#include "plant_sim/plant/plant_parameters.hpp"

namespace levitas::accuracy {

/// The id is one of a gear pair.
[[nodiscard]] std::vector<effect::EffectConfig> DrawGearEffect(
    effect::Id id, double size, const plant::PlantParameters& nominal, Random& random);

}  // namespace levitas::accuracy
