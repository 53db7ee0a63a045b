#pragma once
// The shape parameters of a family, sought between its members.
//
// What       slew rates, knees, widths, clearances and frequencies enter a model in no way that a
//            derivative at "nothing" shows: a few members stand for all (Term::Family). Once one of
//            them is a cause, the best is sought around it: parameter by parameter, Newton's step
//            of its logarithm together with all that is fitted, from runs of two neighbours that
//            are a tenth of the width apart, shortened until it helps; until a round gains less
//            than 10 nat.
// Cost       three runs, a linearisation and mostly one fit for each parameter and round.
// Thread     blocks the caller, two threads inside.
// Failure    none: what does not fit better is not kept.

#include <vector>

#include "diagnosis/inference/refine.hpp"

namespace levitas::diagnosis {

/// True when the hypothesis is a member of a family.
[[nodiscard]] bool HasFamily(const Hypothesis& cause, const std::vector<Term>& terms);

/// `terms` are those of the refiner; those of `cause` become the best member's. `start` is the fit
/// of `causes`, `cause` among them, on `view`. Returns the fit with the best member.
[[nodiscard]] Refined Sharpen(const Refiner& refiner, const Hypothesis& cause,
                              const std::vector<Hypothesis>& causes, const View& view, int passes,
                              Refined start, std::vector<Term>& terms);

}  // namespace levitas::diagnosis
