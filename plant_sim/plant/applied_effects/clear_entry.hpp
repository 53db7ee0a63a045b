#pragma once
// An effect of clear size on a given rig.
//
// Size     that of the catalogue; a factor counts on the rig's own value, a plane on its shaft.
// Thread   any. Failure: std::invalid_argument when the rig cannot have the effect.

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/plant/plant_parameters.hpp"

namespace levitas::plant {

[[nodiscard]] effect::EffectConfig ClearOn(const PlantParameters& rig, effect::Id id);

}  // namespace levitas::plant
