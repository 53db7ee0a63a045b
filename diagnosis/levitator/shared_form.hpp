#pragma once
// The answer of a levitator's diagnosis in the form that those of all rigs have.
//
// Verdict    `none` without causes; `unknown` when what is left stands well above the noise and the
//            causes have not explained most of what calibration left; else `effect`.
// Thread     any.

#include "diagnosis/levitator/levitator_result.hpp"

namespace levitas::levitator {

/// Fills `common` and `ties` from the rest.
void FillSharedForm(const config::RigFile& rig, const NominalRig& nominal,
                    const std::vector<Series>& data, LevitatorResult& answer);

}  // namespace levitas::levitator
