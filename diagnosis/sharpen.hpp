#pragma once
// The shape parameters of a family, sought between its members.
//
// What       slew rates, knees, widths, clearances and frequencies enter a model in no way that a
//            derivative at "nothing" shows: a few members stand for all (Term::Family). Once one of
//            them is a cause, the best is sought around it: parameter by parameter, a parabola
//            through three fits in its logarithm; twice, the second time over a third of the width.
// Cost       six fits for each parameter. Thread: blocks the caller, two threads inside.
// Failure    none: what does not fit better is not kept.

#include <vector>

#include "diagnosis/refine.hpp"

namespace levitas::diagnosis {

/// True when the hypothesis is a member of a family.
[[nodiscard]] bool HasFamily(const Hypothesis& cause, const std::vector<Term>& terms);

/// `terms` are those of the refiner; those of `cause` become the best member's. `start` is the fit
/// of `causes`, `cause` among them, on `view`. Returns the fit with the best member.
[[nodiscard]] Refined Sharpen(const Refiner& refiner, const Hypothesis& cause,
                              const std::vector<Hypothesis>& causes, const View& view, int passes,
                              Refined start, std::vector<Term>& terms);

}  // namespace levitas::diagnosis
