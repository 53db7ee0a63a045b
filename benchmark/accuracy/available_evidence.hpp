#pragma once
// Evidence in the records for a hidden effect, computed from its true parameters without a search
// and without a diagnosis.
//
// Equation   held = L(nominal rig with the effect) - L(nominal rig), both with what else is hidden
//            `beside` it, L the logarithm of the likelihood
//            with all tolerances fitted on the nonlinear model, their priors included, each
//            whitened by its own innovations (Refiner::Misfit). An upper estimate: a diagnosis also
//            pays the Occam factor of the cause.
// None       for what no model foretells (noise, jitter, lost frames, the phase of the mains), and
//            for geared shafts, where it is open in which turn a record begins.
// Units      nat. Thread: blocks the caller, every processor inside.

#include <optional>
#include <vector>

#include "configuration/rig_file.hpp"
#include "diagnosis/model/model_run.hpp"
#include "plant_sim/effect/effect_config.hpp"

namespace levitas::accuracy {

[[nodiscard]] std::optional<double> AvailableEvidence(
    const configuration::RigFile& rig, const std::vector<diagnosis::Record>& records,
    const std::vector<effect::EffectConfig>& hidden,
    const std::vector<effect::EffectConfig>& beside = {});

}  // namespace levitas::accuracy
