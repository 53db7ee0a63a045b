#pragma once
// Descriptions of a session, as text and JSON, shared by the session commands.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "session/log/session_reader.hpp"

namespace levitas::cli {

/// "s.lcmlog: recorded 2026-11-21T05:45:01Z, lockstep, every 100 us, channels de_x de_y".
[[nodiscard]] std::string Describe(const std::string& path, const session::SessionHeader& header);

/// Prints one line when something of the file was lost.
void PrintDamage(const session::Damage& damage);

[[nodiscard]] nlohmann::ordered_json DamageJson(const session::Damage& damage);

}  // namespace levitas::cli
