#pragma once
// Causes that validation data refute one by one.
//
// Why        what a wrong first cause leaves is taken up by a chain of further ones, the weakest of
//            which are worth nothing on data that were not fitted.
// Method     the weakest cause is dropped as long as all causes together foretell the validation
//            data worse than the others without it. A strong one that loses there with a weaker one
//            beside it stays, which would stand in its place otherwise.
// Thread     blocks the caller, every processor inside.

#include <functional>

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/evidence_landscape.hpp"
#include "diagnosis/inference/fit_gain.hpp"

namespace levitas::diagnosis {

/// What the first fit explains of validation data beyond the second, in squared innovations.
using GainOnValidation = std::function<FitGain(const Refined& with, const Refined& without)>;

/// Leaves `kept` causes at least: that the user's data refute the last one is worth saying.
void DropRefuted(EvidenceLandscape& landscape, const SelectionRules& rules,
                 const GainOnValidation& gain, std::size_t kept, CauseSelection& found);

}  // namespace levitas::diagnosis
