#pragma once
// Critical speeds as a command prints them and writes them into its JSON.
//
// Written   `critical_speeds`: an array, empty where nothing is crossed up to `up_to_rpm`.
// Thread    any.

#include <nlohmann/json_fwd.hpp>

#include "analysis/critical_speeds.hpp"

namespace levitas::cli {

/// The array alone.
[[nodiscard]] nlohmann::ordered_json CriticalSpeedsJson(const analysis::Campbell& campbell);

/// `what` crosses: "1x meets a free bending mode, magnets off".
void ShowCriticalSpeeds(const analysis::Campbell& campbell, const char* what,
                        nlohmann::ordered_json& json);

}  // namespace levitas::cli
