#pragma once
// Effects drawn at random, to be hidden in a simulated rig and found by a diagnosis.
//
// Size       1 is clear on the flexible rotor: of the order of 50 to 100 nats in records of 5 s;
//            smaller sizes are shares of it. What a trial's records hold is measured with it.
// Variants   channels (one axis, a bearing, all), planes, modes, orders, signs, phases, and the
//            shapes that laws leave open: exponent of saturation, shape of hysteresis, damping of a
//            support, friction of a rub.
// Units      SI as in the catalogue. Thread: any; pure but for the generator.

#include <span>
#include <string>
#include <vector>

#include "common/random.hpp"
#include "plant_sim/plant/plant_parameters.hpp"

namespace levitas::accuracy {

/// The effects that a rotor on radial bearings can have and that a diagnosis can be asked for.
/// `sample_jitter` is not among them: on a slow rotor it is far below the sensors' noise.
[[nodiscard]] std::span<const effect::Id> HiddenIds();

/// Entries of one effect at this size; more than one when it has several parts.
[[nodiscard]] std::vector<effect::EffectConfig> DrawEffect(effect::Id id, double size,
                                                           const plant::PlantParameters& nominal,
                                                           Random& random);

}  // namespace levitas::accuracy
