#pragma once
// What `amb run` would record of a healthy rig: the control cycle, the scenario's player and the
// plant of the rig file, one period after the other, without processes and links.
//
// Rig      as its file says, effects of the file included; noise from a written seed.
// Rows     levitated ones of the scenario, bearing frame, as LoadRecord gives them.
// Thread   any; no shared state.
// Failure  BadInput when the scenario fails or takes longer than kLongestS: step and reason.

#include "configuration/rig_file.hpp"
#include "diagnosis/model/model_run.hpp"

namespace levitas::diagnosis {

inline constexpr double kLongestS = 300.0;

[[nodiscard]] Record SimulatedRecord(const configuration::RigFile& rig,
                                     const configuration::ControllerFile& controller,
                                     const scenario::ScenarioConfig& scenario, std::uint64_t seed);

}  // namespace levitas::diagnosis
