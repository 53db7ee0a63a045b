#pragma once
// A fault so loud that calibration and whitening hide it: the records are asked once more from the
// rig file's own numbers, without a whitening filter.
//
// Why      The filter is estimated from what the model leaves. Where a fault leaves far more than
//          noise, of one line whose frequency changes with speed, say, the filter takes it for
//          coloured noise, every hypothesis with it, and the calibrated numbers have been bent
//          towards it: the right cause then gains next to nothing.
// Loud     the rms of what is left is kLoud times that behind the filter, on some axis: of noise,
//          which is nearly white here, it is 1.0 to 1.1.
// Decides  the likelihood with a filter of its own for each answer (Refiner::Misfit), which no
//          estimate of the noise from a wrong model can lead astray.
//          The other answer must be better by what suspects a cause (Judging::suspected_nat).
// Cost     where something is loud three linearisations, four fits and three runs; else one run.
// Thread   blocks the caller, every processor inside.

#include <vector>

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/observed_landscape.hpp"

namespace levitas::diagnosis {

/// Whether what runs leave is.
[[nodiscard]] bool IsLoud(const std::vector<Trajectory>& runs, std::size_t axes);

/// After the first search for a cause: a single cause that explains the records better than `found`
/// takes its place. True: it did; the landscape is linearised beside it. Else both are as they
/// were.
[[nodiscard]] bool TakeLoudFault(ObservedLandscape& landscape, const SelectionRules& rules,
                                 CauseSelection& found);

}  // namespace levitas::diagnosis
