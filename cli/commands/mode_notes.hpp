#pragma once
// What `amb modes` says beside its tables: modes that the controller cannot see as they are, and
// modes that the rig file makes less damped than a shaft's material would.
//
// Sampled    a mode above half the sampling rate appears at a lower, false frequency.
// Material   kMaterialDamping, half the loss factor of steel, about 2e-4 (chosen: joints and
//            windage only add to it). A mode below it is a number to check, not an error.
// Thread     any; pure.

#include <string>
#include <vector>

#include "analysis/damped_modes.hpp"

namespace levitas::cli {

inline constexpr double kMaterialDamping = 1e-4;

/// Sentences, one per kind; none where there is nothing to say.
[[nodiscard]] std::vector<std::string> ModeNotes(const std::vector<analysis::DampedMode>& modes,
                                                 double sampling_hz);

}  // namespace levitas::cli
