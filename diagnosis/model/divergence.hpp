#pragma once
// Divergence of the model or of its sensitivities, and the observers that prevent it.
//
// Why        a magnet pulls harder the nearer the rotor is. A model that an unknown effect drives
//            far enough from the measured rotor falls into the magnet, and a slow observer cannot
//            prevent it. Its misfit and slopes then carry no information about the rig. A faster
//            observer shows less of slow effects and holds the model until the cause is
//            known.
// Model      diverges: a predicted reading beyond kShare of the clearance that is also kTimes as
//            far out as any measured one of its record, or no number at all.
// Sensitivities  diverge: beyond 3000 rms of the noise per scale of their term: under a wrong cause
//            the model nearly loses the rotor, and slightly different models do.
// Thread     any; pure.

#include <vector>

#include "diagnosis/model/model_run.hpp"
#include "diagnosis/model/normal_equations.hpp"
#include "diagnosis/model/rig_view.hpp"

namespace levitas::diagnosis {

[[nodiscard]] bool ModelDiverges(const RigView& rig, const std::vector<Trajectory>& runs);
/// Sums of all terms' derivatives, each per its scale.
[[nodiscard]] bool SensitivitiesDiverge(const NormalEquations& sum);
/// Without end: no evidence can be taken from what is not a number, not even that nothing is wrong.
[[nodiscard]] bool SensitivitiesAreLost(const NormalEquations& sum);

}  // namespace levitas::diagnosis
