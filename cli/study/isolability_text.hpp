#pragma once
// What records can tell apart, for people and as JSON.
//
// Thread  any; pure.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "diagnosis/isolability/what_splits.hpp"

namespace levitas::cli {

[[nodiscard]] std::string IsolabilityText(const std::vector<diagnosis::Foretold>& all);
[[nodiscard]] std::string SplitsText(const std::vector<diagnosis::Foretold>& all,
                                     const std::vector<diagnosis::Tried>& tried);

/// `matrix`: every effect against every other, evidence and what is left.
[[nodiscard]] nlohmann::ordered_json IsolabilityJson(const std::vector<diagnosis::Foretold>& all,
                                                     const std::vector<diagnosis::Tried>& tried);

/// Index into `tried` of the scenario that helps most faults; none when no scenario does.
[[nodiscard]] std::optional<std::size_t> BestScenario(const std::vector<diagnosis::Foretold>& all,
                                                      const std::vector<diagnosis::Tried>& tried);

}  // namespace levitas::cli
