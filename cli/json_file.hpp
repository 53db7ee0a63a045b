#pragma once
// The --json FILE of every command that computes.
//
// Keys     every object begins with `schema`, the command and the number of its keys' meaning
//          ("levitas_margins_1": the number rises when a key changes its meaning or goes, not when
//          one is added), and `version`, of the program.
// To "-"   on standard output, as the only thing there: the text goes to standard error
//          (standard_output.hpp).
// Failure  BadInput when the file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace levitas {
struct RigNumbers;
}  // namespace levitas

namespace levitas::cli {

struct FoundController;

inline constexpr const char* kJsonToStandardOutput = "-";

/// The command whose JSON is written in this program, its words joined by _.
void NameJson(const std::string& command);

/// Writes `content`, indented; does nothing when `path` is empty.
void WriteJsonFile(const std::string& path, const nlohmann::ordered_json& content);

/// The beginning of what a command on the closed loop writes: rig, controller, delay.
[[nodiscard]] nlohmann::ordered_json LoopJson(const RigNumbers& rig,
                                              const FoundController& controller, double delay_s);

}  // namespace levitas::cli
