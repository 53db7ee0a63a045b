#pragma once
// Keys of diagnosis.json as version 1.0 wrote them. Scripts may read them until version 2.0.
//
// Renamed  what speaks of validation data had three words: fit_percent.holdout_*,
//          candidates[].held_out_nat, runs_held_out. Now validation_*, validation_nat and
//          runs_validation.
// Thread   any. Failure: none; a key that is not there has no old one either.

#include <nlohmann/json_fwd.hpp>

namespace levitas::report {

/// Adds the old keys with the values of the new ones.
void AddOldKeys(nlohmann::ordered_json& diagnosis);

}  // namespace levitas::report
