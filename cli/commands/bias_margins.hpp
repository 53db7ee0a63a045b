#pragma once
// What of amb margins is about bias saving: the loop at every bias that it may take.
//
// Thread   any; JudgeBias is pure, PrintBias prints.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/sensitivity.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::cli {

struct LoopAtBias {
  double bias_a{};
  analysis::SensitivityResult loop;
};

/// From the rig's bias, at which the loops are judged already, to the lowest in equal ratios. Empty
/// without bias saving.
[[nodiscard]] std::vector<LoopAtBias> JudgeBias(
    const configuration::RigFile& rig, const configuration::ControllerFile& controller,
    const std::vector<analysis::SensitivityResult>& at_rig_bias);

/// A line for each, and the key `bias_saving` of the answer; nothing without any.
void PrintBias(const std::vector<LoopAtBias>& loops, const std::vector<std::string>& channels,
               nlohmann::ordered_json& json);

}  // namespace levitas::cli
