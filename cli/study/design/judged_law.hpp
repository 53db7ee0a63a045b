#pragma once
// A designed law as files: under the name asked for when its check accepted it, beside it when not.
// Thread   that of the caller.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "design/gate/gate.hpp"

namespace levitas::cli {

/// What the coils leave for control on both sides of the bias [A].
[[nodiscard]] double ControlLimitA(const RigNumbers& rig);

/// OUT, or OUT.rejected.yaml with OUT.worst_rig.yaml; returns what was written. An empty OUT writes
/// nothing. `command`: who made it, for the file's first line.
[[nodiscard]] std::vector<std::string> WriteJudged(const std::string& out_path,
                                                   const std::string& command, std::uint64_t seed,
                                                   const configuration::ControllerFile& file,
                                                   const RigNumbers& rig,
                                                   const design::GateResult& result);

}  // namespace levitas::cli
