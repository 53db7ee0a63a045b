#pragma once
// Competing hypotheses: every effect in place of the first cause (step 4 of diagnose.hpp).
//
// Thread  blocks the caller, two threads inside.

#include "diagnosis/inference/search_state.hpp"

namespace levitas::diagnosis {

/// Puts the strongest cause first and tries every effect in its place, on the linearisation.
void RankCandidates(SearchState& state);

/// Refits the alternatives near the first cause on the nonlinear model; the best becomes first.
void RefitAlternatives(SearchState& state);

/// What leads after all refits must still be decisive against the rest of the causes, refitted
/// without it; else it goes, and the rest is to be ranked anew: true.
[[nodiscard]] bool LeaderFails(SearchState& state);

}  // namespace levitas::diagnosis
