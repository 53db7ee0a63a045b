#pragma once
// A comparison of recorded runs as tables for people and as JSON.
// Thread  plain data.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "report/session/comparison.hpp"

namespace levitas::cli {

/// What is compared, the table of the control currents and that of the positions.
[[nodiscard]] std::string ComparisonText(const report::Comparison& comparison);

[[nodiscard]] nlohmann::ordered_json ComparisonJson(const report::Comparison& comparison);

}  // namespace levitas::cli
