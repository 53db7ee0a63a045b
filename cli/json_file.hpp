#pragma once
// The --json FILE of every command that computes.
//
// Failure  BadInput when the file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace levitas::cli {

/// Writes `content`, indented; does nothing when `path` is empty.
void WriteJsonFile(const std::string& path, const nlohmann::ordered_json& content);

}  // namespace levitas::cli
