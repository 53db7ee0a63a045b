#pragma once
// Models that lose the rotor they are to follow, and the observers that hold them.
//
// Why        a magnet pulls the harder the nearer the rotor: a model that is driven far enough from
//            the measured rotor, by an effect it does not know, falls into the magnet whatever a
//            slow observer does. Nothing can be learnt from there: neither misfit nor slopes speak
//            of the rig any more. A faster observer sees less and holds the model until the cause
//            is known.
// Strays     a predicted reading beyond kShare of the clearance that is also kTimes as far out as
//            any measured one of its record, or no number at all.
// Runs away  derivatives that grow along the run until they say nothing: a model that is led by a
//            wrong cause nearly loses the rotor, and its neighbours do.
// Thread     any; pure.

#include <vector>

#include "diagnosis/model/model_run.hpp"
#include "diagnosis/model/normal_equations.hpp"
#include "diagnosis/model/rig_view.hpp"

namespace levitas::diagnosis {

[[nodiscard]] bool Strays(const RigView& rig, const std::vector<Trajectory>& runs);
/// Sums of all terms' derivatives, each per its scale.
[[nodiscard]] bool RunsAway(const NormalEquations& sum);

}  // namespace levitas::diagnosis
