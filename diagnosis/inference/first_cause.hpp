#pragma once
// Causes added until none gains enough, and the same from other first causes.
//
// Why        a chain of causes that are all small beside the first one is the mark of a wrong first
//            one: they take up what it leaves. The backward check cannot find that, since each of
//            them is decisive beside it.
// Method     where all others gain less than a tenth of the first one's evidence, the nearest
//            effects begin a selection each in its place; the best evidence stays.
// Landscape  one that whitens once for all: evidence is compared across LineariseAt.
// Thread     blocks the caller, every processor inside.

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/evidence_landscape.hpp"

namespace levitas::diagnosis {

/// From the causes that are there already. Each is refitted at every place of its effect: where the
/// laws bend, the screen may mistake one for another.
void AddCauses(EvidenceLandscape& landscape, const SelectionRules& rules, CauseSelection& found);

/// Nothing with fewer than two causes.
void ReconsiderFirstCause(EvidenceLandscape& landscape, const SelectionRules& rules,
                          CauseSelection& found);

}  // namespace levitas::diagnosis
