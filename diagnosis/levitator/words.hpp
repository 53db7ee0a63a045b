#pragma once
// Words of the workshop that speak of a rotor, said of a ball (plant_sim/effect/workshop.hpp has
// the rest).
//
// Thread  any; constant data.

#include <vector>

#include "plant_sim/effect/workshop.hpp"

namespace levitas::levitator {

[[nodiscard]] const std::vector<effect::Words>& OwnWords();

}  // namespace levitas::levitator
