#pragma once
// A fault of stated place and size for each effect of the vocabulary, to foretell what records
// would show of it.
//
// Size    that of the catalogue, `clear` (`amb effects ID`), what shows clearly on a laboratory
//         rig, at a strength from 0 to 1 (strength.hpp).
// Place   channels: the first one; a bearing: the first; a mode: the first bending; a plane: that
//         of the middle disc of the rig file's list, and without discs the catalogue's share of
//         the shaft.
// Thread  any; pure.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/model/rig_view.hpp"
#include "plant_sim/effect/effect_config.hpp"

namespace levitas::diagnosis {

struct StatedFault {
  effect::EffectConfig entry;
  std::string size;   ///< "ratio 0.8", keys and units of a rig file
  std::string place;  ///< "de_x"; empty: the whole rig
};

/// None for an effect that this rig cannot have: teeth without gears, bending of a rigid rotor.
[[nodiscard]] std::optional<StatedFault> StatedFaultOf(effect::Id id, const RigView& rig,
                                                       double strength = 1.0);

/// All of the catalogue that the rig can have and a diagnosis looks for.
[[nodiscard]] std::vector<StatedFault> StatedFaults(const RigView& rig, double strength = 1.0);

}  // namespace levitas::diagnosis
