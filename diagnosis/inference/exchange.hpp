#pragma once
// Exchange step of the model selection: each cause is replaced by its nearest alternative.
//
// Why        causes are found in sequence, and the second is chosen while the first is still
//            biased by the effect not found yet: with an unknown delay the estimate of a slew limit
//            is a little off, and a slow sensor then fits better than the delay.
// Method     the shape parameters of all causes are refined together. Then each cause in turn is
//            replaced by the nearest alternatives, all shapes refined again; the best set stays.
// Thread     blocks the caller, every processor inside.

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/evidence_landscape.hpp"

namespace levitas::diagnosis {

/// Nothing with fewer than two causes.
void ExchangeCauses(EvidenceLandscape& landscape, const SelectionRules& rules,
                    CauseSelection& found);

}  // namespace levitas::diagnosis
