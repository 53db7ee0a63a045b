#pragma once
// An entry of a rig file's list of effects, for tests.

#include <algorithm>
#include <cstdint>
#include <initializer_list>

#include "plant_sim/effect/effect_config.hpp"

namespace levitas::test {

/// With these values, in the order of the catalogue, SI units.
[[nodiscard]] inline effect::EffectConfig Entry(effect::Id id, std::initializer_list<double> values,
                                                std::uint32_t axes = effect::kAllAxes) {
  effect::EffectConfig entry;
  entry.id = id;
  entry.axes = axes;
  std::copy(values.begin(), values.end(), entry.values.begin());
  return entry;
}

}  // namespace levitas::test
