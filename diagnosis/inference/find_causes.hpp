#pragma once
// Forward selection of causes (2 and 3 of diagnose.hpp), under observers as slow as the model with
// the causes found so far allows.
//
// Thread  blocks the caller, two threads inside.

#include "diagnosis/inference/record_landscape.hpp"

namespace levitas::diagnosis {

/// Adds the best cause while one gains enough (selection_steps.hpp). `found` has the calibrated
/// model; the landscape ends linearised at the last fit.
/// `all` are the records before spans were taken.
void FindCauses(RecordLandscape& landscape, const std::vector<Record>& all,
                const SelectionRules& rules, CauseSelection& found);

}  // namespace levitas::diagnosis
