#pragma once
// Parameters and entries of causes that no term of the model describes: lost frames, noise level
// (diagnosis/inference/events.hpp).
//
// Lost     probability: bursts over frames that were not within one, as plant_sim draws them; its
//          interval is that of a Poisson count. burst_samples: their mean length, rounded.
// Noise    rms_um: the level that was found, less the converter's steps, which the rig adds itself.
//          How well it is known is not said: the interval is the value.
// Thread   any; pure.

#include <vector>

#include "diagnosis/report/diagnosis_report.hpp"
#include "plant_sim/effect/effect_config.hpp"

namespace levitas::diagnosis {

struct DiagnosisResult;

[[nodiscard]] std::vector<NamedParameter> EventParameters(const DiagnosisResult& answer);
[[nodiscard]] std::vector<effect::EffectConfig> EventEntries(const DiagnosisResult& answer);

}  // namespace levitas::diagnosis
