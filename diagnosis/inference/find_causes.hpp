#pragma once
// Forward selection of causes (2 and 3 of diagnose.hpp), under observers as slow as the model with
// the causes found so far allows.
//
// Thread  blocks the caller, every processor inside.

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/observed_landscape.hpp"

namespace levitas::diagnosis {

/// Adds the best cause while one gains enough (selection_steps.hpp). `found` has the calibrated
/// model; the landscape ends linearised at the last fit.
void FindCauses(ObservedLandscape& landscape, const SelectionRules& rules, CauseSelection& found);

}  // namespace levitas::diagnosis
