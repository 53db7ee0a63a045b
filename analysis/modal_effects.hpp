#pragma once
// The rotor of a rig file with the effects that change its free modes (effect::Modes).
//
// Free       a rotor in its surroundings, magnets without current: what acts through the magnets
//            (currents, ki, ks, a moving support) changes the modes of the loop alone, which are
//            poles (poles.hpp).
// Turning    anisotropy and cracks turn with the rotor: the free rotor then has no frequencies that
//            stay the same over a turn.
// Thread     any; pure.

#include <vector>

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

/// The rig with those effects alone that change the modes of the free rotor, at full strength from
/// the start.
[[nodiscard]] plant::PlantConfig WithModalEffects(const plant::PlantConfig& plant);

}  // namespace levitas::analysis
