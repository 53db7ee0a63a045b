#pragma once
// What records hold for a hidden effect, from the effect itself: no search, no verdict of a
// diagnosis takes part.
//
// Equation   d = e(nominal rig) - e(nominal rig with the effect), innovations of the slow observer on
//            the recorded currents; held = 1/2 min over t of |d + J t|^2 + |t|^2: what tolerances,
//            in units of themselves, cannot imitate of it. Innovations over what the sensors' noise
//            makes of them. An upper estimate: a real fit also pays for the freedom of the cause and
//            for what the model leaves otherwise.
// None       for what no model foretells (noise, jitter, lost frames, the phase of the mains), and for
//            geared shafts, where it is open in which turn a record begins.
// Units      nat. Thread: blocks the caller, two threads inside.

#include <optional>
#include <vector>

#include "config/rig_file.hpp"
#include "diagnosis/model_run.hpp"
#include "plant_sim/effect/effect_config.hpp"

namespace levitas::trials {

[[nodiscard]] std::optional<double> HeldEvidence(const config::RigFile& rig,
                                                 const std::vector<diagnosis::Record>& records,
                                                 const std::vector<effect::EffectConfig>& hidden);

}  // namespace levitas::trials
