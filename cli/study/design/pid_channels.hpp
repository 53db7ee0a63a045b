#pragma once
// PIDs of translation and tilt as text and JSON: the file that a loop runs holds them as blocks of
// poles, in which nobody reads a gain.
// Law      one entry per channel: translation x, translation y, tilt x, tilt y; x and y alike.
// Thread   that of the caller.

#include <nlohmann/json.hpp>
#include <string>

#include "controller/law/law_config.hpp"

namespace levitas::cli {

/// "translation Kp 14500 A/m, Ki 72500 A/(m s), Kd 21 A s/m; tilt ..."
[[nodiscard]] std::string ChannelsText(const law::LawConfig& channels);
[[nodiscard]] nlohmann::ordered_json ChannelsJson(const law::LawConfig& channels);

}  // namespace levitas::cli
