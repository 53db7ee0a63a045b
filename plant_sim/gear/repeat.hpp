#pragma once
// After how many turns of its driving wheel a gear pair brings the same teeth together again.
//
// Equation   z2 / gcd(z1, z2), a whole number.
// Thread     any; pure. Failure: none; the numbers of teeth are above 0.

#include <numeric>

#include "plant_sim/gear/gear_config.hpp"

namespace levitas::gear {

[[nodiscard]] inline int TurnsPerRepeat(const GearPair& pair) {
  return pair.driven.teeth / std::gcd(pair.driving.teeth, pair.driven.teeth);
}

}  // namespace levitas::gear
