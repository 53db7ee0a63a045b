#pragma once
// Steps of the forward selection of causes with backward checks (2 and 3 of diagnose.hpp): each
// changes `found` by what the landscape says, and nothing else.
//
// Thread  blocks the caller, every processor inside.

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/evidence_landscape.hpp"

namespace levitas::diagnosis {

/// Screens, refits the best few and adds the best, if it gains enough; earlier causes that it makes
/// superfluous go. `share` of the whole diagnosis is done. False: none gains enough.
[[nodiscard]] bool AddCause(const EvidenceLandscape& landscape, const SelectionRules& rules,
                            double share, CauseSelection& found);

/// `fit` of all causes becomes that with the best shape of the last one.
void RefineLastShape(const EvidenceLandscape& landscape, Refined& fit, CauseSelection& found);

/// Replaces two causes, or all, by a single effect that explains the data as well: forward
/// selection may have imitated it by several.
void MergeCauses(EvidenceLandscape& landscape, const SelectionRules& rules, CauseSelection& found);

/// Backward check: drops causes that are not decisive given the others, the weakest first.
void DropUnproven(const EvidenceLandscape& landscape, const SelectionRules& rules,
                  CauseSelection& found);

/// Doubts several causes that are as many as there may be where a further one would be decisive: a
/// chain imitates what is not in the vocabulary.
void DoubtCutOffChain(const EvidenceLandscape& landscape, const SelectionRules& rules,
                      CauseSelection& found);

}  // namespace levitas::diagnosis
