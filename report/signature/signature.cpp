#include "report/signature/signature.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plant_sim/plant/effects/apply_effects.hpp"

namespace levitas::signature {

using effect::Id;
using effect::Shows;

effect::EffectConfig ClearOn(const plant::PlantParameters& rig, Id id) {
  effect::EffectConfig entry = effect::ClearEntry(id);
  const plant::Values own = plant::OwnValues(rig, entry, 0);
  const auto parameters = effect::At(id).parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (std::isnan(parameters[i].neutral)) entry.values[i] = parameters[i].clear * own[i];
    // Planes of the table are those of a shaft of half a metre.
    if (parameters[i].stem == "z" && parameters[i].clear > 0.0) {
      entry.values[i] = parameters[i].clear / 0.4572 * rig.modes.node_z_m.back();
    }
  }
  return entry;
}

svg::Figure Picture(const plant::PlantParameters& rig, const effect::EffectConfig& entry) {
  Pair rigs{rig, rig};
  rigs.without.config.effects.clear();
  rigs.with.config.effects = {entry};
  svg::Figure figure;
  figure.title = std::string(effect::At(entry.id).name);
  figure.columns = 3;
  switch (effect::At(entry.id).facts.shows_in) {
    case Shows::kResponse:
      figure.panels = ResponsePanels(rigs);
      break;
    case Shows::kSpectrum:
      figure.panels = SpectrumPanels(rigs);
      break;
    case Shows::kForce:
      figure.panels = ForcePanels(rigs);
      break;
    case Shows::kGearMesh:
      figure.panels = GearPanels(rigs);
      break;
  }
  return figure;
}

}  // namespace levitas::signature
