#pragma once
// Causes by forward selection with backward checks (2 and 3 of diagnosis.hpp).
//
// Thread  blocks the caller, two threads inside.

#include "diagnosis/inference/inquiry.hpp"

namespace levitas::diagnosis {

/// Screens, refits the best few and adds the best, as long as one gains enough.
void FindCauses(Inquiry& inquiry);

/// Of causes that only together imitate one which the first choice passed by, that one is kept: any
/// effect in place of all of them or of two, as long as one does what they did.
void MergeCauses(Inquiry& inquiry);

/// Nothing is named that is not decisive beside the others; the weakest goes first.
void DropUnproven(Inquiry& inquiry);

}  // namespace levitas::diagnosis
