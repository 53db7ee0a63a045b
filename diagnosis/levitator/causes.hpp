#pragma once
// The causes that are considered: which parameters move together, beyond their tolerances.
//
// Prior      each effect counts the same: one that may show in several ways pays the logarithm of
//            their number.
// Thread     any; pure.

#include <string>
#include <vector>

#include "diagnosis/levitator/parameters.hpp"

namespace levitas::levitator {

struct Cause {
  std::string effect;
  std::string where;  ///< "amplifier", "magnet: force" ...
  std::vector<std::size_t> moves;
  double log_prior{};
};

[[nodiscard]] const std::vector<Cause>& Causes();

}  // namespace levitas::levitator
