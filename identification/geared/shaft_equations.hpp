#pragma once
// The sum of both shafts' equations, which has no mesh in it, solved for what belongs to the
// shafts.
//
// Unknowns  ks, ki and the unbalance m eps of either shaft; with uncertain known numbers also a
//           relative correction of each, held to 0 by its uncertainty (full_spectrum.hpp).
// Noise     stands in the unknowns' factors; every round moves the lines to where the equation of
//           the round before holds, by the shortest way in units of their noise, as in total least
//           squares (Golub & Van Loan 1980). Left there, it would draw all unknowns towards 0.
// Thread    any. Failure: BadInput of LineEquations.

#include <vector>

#include "identification/geared/full_spectrum.hpp"
#include "identification/geared/line_equations.hpp"

namespace levitas::identification {

/// Numbers of a shaft that are off together.
using Numbers = std::vector<double ShaftKnown::*>;
/// What can be off by itself: a shaft's stiffnesses are off together.
[[nodiscard]] const std::vector<Numbers>& Correctable();
void Scale(ShaftKnown& shaft, const Numbers& numbers, double factor);

/// Standard deviation of one line's sum of both equations; 1 when nothing is known of it.
[[nodiscard]] double SumSigma(const GearedLine& line, const GearedKnown& known,
                              const GearedParameters& p);

/// `p` is the round before's; of the first, empty.
[[nodiscard]] Solution SolveShafts(const std::vector<GearedLine>& lines, const GearedKnown& known,
                                   const GearedParameters& p);
[[nodiscard]] GearedKnown Corrected(const GearedKnown& known, const Solution& solution);
/// Both shafts of a solution.
void TakeShafts(const Solution& solution, const GearedKnown& corrected, GearedParameters& p);

}  // namespace levitas::identification
