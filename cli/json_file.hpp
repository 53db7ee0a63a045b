#pragma once
// The --json FILE of every command that computes.
//
// Failure  BadInput when the file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace levitas {
struct RigNumbers;
}  // namespace levitas

namespace levitas::cli {

struct FoundController;

/// Writes `content`, indented; does nothing when `path` is empty.
void WriteJsonFile(const std::string& path, const nlohmann::ordered_json& content);

/// The beginning of what a command on the closed loop writes: rig, controller, delay.
[[nodiscard]] nlohmann::ordered_json LoopJson(const RigNumbers& rig,
                                              const FoundController& controller, double delay_s);

}  // namespace levitas::cli
