#pragma once
// Causes that calibration has swallowed: looked for from the rig file's numbers on.
//
// Why       a spring at the coupling moves modes as wrong shapes would. Calibration, which knows
//           shapes alone, takes them six tolerances from the file, and no straight line leads back
//           from there: the spring is screened as worth much, and fitted beside it.
// When      calibration has left a number, a shape of a mode included, surely beyond
//           moved_tolerances (moved_calibration.hpp), and the first cause found about it, if there
//           is one, does not bring it back.
// Method    under a fast observer the cost is smooth, and no filter takes what a slow one leaves of
//           a lightly damped mode for coloured noise. On a few rows every effect is screened about
//           the file's numbers; each of the first few is fitted together with the nuisances from
//           there on, what is built being held to a fifth of its tolerance at first
//           (calibrate.hpp).
//           While the best of them still leaves numbers far off, a further one is looked for.
// Without   the nuisances alone go the same way: a calibration that had lost its way, and not to a
//           cause, is replaced.
// Taken     where innovations and all that calibration pays for its moves cost less with it than
//           without, and than with what was found so far, by suspected_nat: a model is never exact.
//           The search then goes on with it, and drops it again where further causes explain its
//           share, still under the fast observer: find_causes.cpp goes back to slower ones.
// Cost      for each cause a screen, and up to three joint fits of up to six descents; on a part of
//           the records, and once on all of them.
// Thread    blocks the caller, every processor inside.

#include <vector>

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/observed_landscape.hpp"

namespace levitas::diagnosis {

/// Whether a fit left a number, shapes of modes included, surely beyond the tolerances. `theta` is
/// where it ended, `problem` is about that.
[[nodiscard]] bool WentFar(const std::vector<Term>& terms, const LinearProblem& problem,
                           const std::vector<double>& theta, const std::vector<Hypothesis>& causes,
                           double tolerances);

/// True when any was taken. A calibration that is replaced takes the causes found about it along.
/// The landscape is linearised at found.point before and after.
bool TakeSwallowedCauses(ObservedLandscape& landscape, const SelectionRules& rules,
                         CauseSelection& found);

}  // namespace levitas::diagnosis
