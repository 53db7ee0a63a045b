#include "analysis/modal_effects.hpp"

#include <vector>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::analysis {

plant::PlantConfig WithModalEffects(const plant::PlantConfig& plant) {
  plant::PlantConfig with = plant;
  std::erase_if(with.effects, [](const effect::EffectConfig& entry) {
    return effect::At(entry.id).facts.modes != effect::Modes::kOnTheRotor;
  });
  for (effect::EffectConfig& entry : with.effects) entry.at_s = entry.ramp_s = 0.0;
  return with;
}

}  // namespace levitas::analysis
