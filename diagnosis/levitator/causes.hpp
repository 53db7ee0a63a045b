#pragma once
// The causes that are considered: which parameters move together, beyond their tolerances.
//
// Prior      each effect counts the same: one that may show in several ways pays the logarithm of
//            their number.
// Thread     any; pure.

#include <vector>

#include "diagnosis/inference/hypothesis.hpp"
#include "diagnosis/levitator/parameters.hpp"

namespace levitas::levitator {

/// Their terms are parameters of the table; directions are left empty.
[[nodiscard]] const std::vector<diagnosis::Hypothesis>& AllCauses();

/// Whether two effects do much the same to the data by their physics, so that one is always tried
/// in the other's place: the weight is carried by force constant, mass, gap and current alike.
[[nodiscard]] bool Alike(effect::Id one, effect::Id other);

}  // namespace levitas::levitator
