#pragma once
// Words of the workshop for what only a ball between two magnets on a voltage has
// (plant_sim/effect/workshop.hpp has the rest).
//
// Thread  any; constant data.

#include <vector>

#include "plant_sim/effect/workshop.hpp"

namespace levitas::levitator {

[[nodiscard]] const std::vector<effect::Words>& OwnWords();

}  // namespace levitas::levitator
