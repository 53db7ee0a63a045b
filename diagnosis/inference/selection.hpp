#pragma once
// Causes by forward selection with backward checks (2 and 3 of diagnose.hpp).
//
// Thread  blocks the caller, two threads inside.

#include "diagnosis/inference/search_state.hpp"

namespace levitas::diagnosis {

/// Forward selection: screens, refits the best few and adds the best while one gains enough.
void FindCauses(SearchState& state);

/// Replaces two causes, or all, by a single effect that explains the data as well: forward
/// selection may have imitated it by several.
void MergeCauses(SearchState& state);

/// Backward check: drops causes that are not decisive given the others, the weakest first.
void DropUnproven(SearchState& state);

}  // namespace levitas::diagnosis
