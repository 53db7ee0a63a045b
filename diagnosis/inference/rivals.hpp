#pragma once
// Every effect in place of the first cause (4 of diagnosis.hpp).
//
// Thread  blocks the caller, two threads inside.

#include "diagnosis/inference/inquiry.hpp"

namespace levitas::diagnosis {

/// The strongest cause leads; every effect is then tried in its place, on the linearisation.
void RankCandidates(Inquiry& inquiry);

/// Who comes near the first cause by extrapolation, on the nonlinear model. The best one leads.
void RefitRivals(Inquiry& inquiry);

/// What leads after all refits must still be decisive against the rest of the causes, refitted
/// without it; else it goes, and the rest is to be ranked anew: true.
[[nodiscard]] bool LeaderFails(Inquiry& inquiry);

}  // namespace levitas::diagnosis
