#pragma once
// Entries of a rig file for effects of teeth, from what their terms found.
//
// Thread  any; pure.

#include <map>
#include <string>

#include "diagnosis/report/effect_entry.hpp"
#include "plant_sim/effect/effect_config.hpp"

namespace levitas::diagnosis {

/// gear: mesh, order: 2 and so on for the place and the numbers of GearTerms, parameter by name.
[[nodiscard]] EntryValues GearEntry(const RigView& rig, effect::Id id, const std::string& place,
                                    const std::map<std::string, double>& theta);

/// The pair that a place speaks of; null for another place.
[[nodiscard]] const MeshView* MeshOf(const RigView& rig, const std::string& place);

}  // namespace levitas::diagnosis
