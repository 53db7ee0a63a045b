#pragma once
// Entries of a rig file for effects of teeth, from what their terms found.
//
// Thread  any; pure.

#include "diagnosis/report/effect_entry.hpp"
#include "plant_sim/effect/effect_config.hpp"

namespace levitas::diagnosis {

[[nodiscard]] EntryValues GearEntry(const RigView& rig, effect::Id id, const PlacedEffect& at);

}  // namespace levitas::diagnosis
