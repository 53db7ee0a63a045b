#pragma once
// The part of a rotor's rig that a diagnosis points at, and the channels that show it.
//
// Thread   any; pure. Failure: none.

#include <string>
#include <vector>

#include "plant_sim/effect/effect_config.hpp"

namespace levitas::diagnosis {

struct DiagnosisResult;

/// "magnet", "sensor" ...; for an unknown, that of the signal which the residual follows.
[[nodiscard]] std::string PlaceOf(const DiagnosisResult& result);
[[nodiscard]] std::string PlaceOfEffect(effect::Id id);
/// The place of a residual without a cause, from the signal that it follows.
[[nodiscard]] std::string PlaceOfResidual(const std::string& coherent_with);
[[nodiscard]] std::vector<std::string> Channels(const DiagnosisResult& result);

}  // namespace levitas::diagnosis
