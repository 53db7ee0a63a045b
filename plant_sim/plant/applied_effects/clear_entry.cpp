#include "plant_sim/plant/applied_effects/clear_entry.hpp"

#include <cmath>

#include "plant_sim/plant/applied_effects/apply_effects.hpp"

namespace levitas::plant {
namespace {

/// Planes of the catalogue are those of the shaft of flexible_rotor.
constexpr double kCatalogueShaftM = 0.4572;

}  // namespace

effect::EffectConfig ClearOn(const PlantParameters& rig, effect::Id id) {
  effect::EffectConfig entry = effect::ClearEntry(id);
  const Values own = OwnValues(rig, entry, 0);
  const auto parameters = effect::At(id).parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (std::isnan(parameters[i].neutral)) entry.values[i] = parameters[i].clear * own[i];
    if (parameters[i].stem == "z" && parameters[i].clear > 0.0) {
      entry.values[i] = parameters[i].clear / kCatalogueShaftM * rig.modes.node_z_m.back();
    }
  }
  return entry;
}

}  // namespace levitas::plant
