#pragma once
// What a person reads of `amb balance`: text, JSON and a picture of the orbits over speed.
// Thread   any. Failure: BadInput when a file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "identification/balance/balance.hpp"

namespace levitas::report {

[[nodiscard]] std::string BalanceText(const balancing::BalanceRequest& request,
                                      const balancing::BalanceResult& result);
[[nodiscard]] nlohmann::ordered_json BalanceJson(const balancing::BalanceRequest& request,
                                                 const balancing::BalanceResult& result);
/// Nothing for an empty path.
void WriteBalancePicture(const std::string& path, const balancing::BalanceRequest& request,
                         const balancing::BalanceResult& result);

}  // namespace levitas::report
