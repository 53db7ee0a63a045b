#pragma once
// Refinement of the shape parameters of a family between its members.
//
// Why        slew rates, knees, widths, clearances and frequencies have no derivative at amplitude
//            zero, so that a family is screened by a few members (Term::Family).
// Method     around the member that was chosen as a cause, one parameter at a time: Newton's step
//            of its logarithm together with all fitted parameters, from runs of two neighbours a
//            tenth of the width apart; shortened until the cost falls; until a round gains less
//            than 10 nat.
// Cost       three runs, a linearisation and mostly one fit for each parameter and round.
// Thread     blocks the caller, every processor inside.
// Failure    none: a step that does not improve the fit is not kept.

#include <vector>

#include "diagnosis/inference/member_fits.hpp"

namespace levitas::diagnosis {

/// True when the hypothesis is a member of a family.
[[nodiscard]] bool HasFamily(const Hypothesis& cause, const std::vector<Term>& terms);

/// `start` is the fit of causes with `cause` among them, to which `fits` belongs. Returns the fit
/// with the best member, whose shape is that of its point. Ends when the evidence `worth` is out of
/// reach though all further rounds gained as much as the last one.
[[nodiscard]] Refined RefineShape(const MemberFits& fits, const Hypothesis& cause, Refined start,
                                  const std::vector<Term>& terms, double worth = kAnyEvidence);

}  // namespace levitas::diagnosis
