#pragma once
// Competing hypotheses: every effect in place of the first cause (step 4 of diagnose.hpp).
//
// Thread  blocks the caller, every processor inside.

#include <vector>

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/evidence_landscape.hpp"

namespace levitas::diagnosis {

/// Puts the strongest cause first and tries every effect in its place, on the linearisation.
void RankCandidates(const EvidenceLandscape& landscape, const SelectionRules& rules,
                    CauseSelection& found);

/// The same for every cause, the weightiest first, with the alternatives refitted; a better one
/// takes the place of its cause. One list for each cause, itself included; without a cause one.
[[nodiscard]] std::vector<std::vector<Candidate>> RankInPlaceOfEach(EvidenceLandscape& landscape,
                                                                    const SelectionRules& rules,
                                                                    CauseSelection& found);

/// Refits the alternatives near the first cause on the nonlinear model; the best becomes first.
void RefitAlternatives(const EvidenceLandscape& landscape, const SelectionRules& rules,
                       CauseSelection& found);

/// Drops the leading cause if it is not decisive once the others are refitted without it. True if
/// so: the rest is to be ranked again.
[[nodiscard]] bool DropFailedLeader(EvidenceLandscape& landscape, const SelectionRules& rules,
                                    CauseSelection& found);

}  // namespace levitas::diagnosis
