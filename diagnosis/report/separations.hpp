#pragma once
// Which effects of a rotor's rig look alike, and which records tell them apart. The one table of
// it: the advice for a tie and the scenario for the next records both ask here.
//
// Thread   any; pure. Failure: none.

#include <string_view>
#include <vector>

#include "plant_sim/effect/effect_config.hpp"

namespace levitas::diagnosis {

/// What to record to tell the cause from one of the others; empty where the table has no pair.
[[nodiscard]] std::string_view SeparatingRecord(effect::Id cause,
                                                const std::vector<effect::Id>& others);

/// Whether it can be told from its likes only above the amplifiers' bandwidth.
[[nodiscard]] bool NeedsFastSignal(effect::Id id);

}  // namespace levitas::diagnosis
