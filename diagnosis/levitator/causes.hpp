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

/// Whether two effects do much the same to the data by their physics, so that one is always tried
/// in the other's place: the weight is carried by force constant, mass, gap and current alike.
[[nodiscard]] bool Alike(const std::string& one, const std::string& other);

}  // namespace levitas::levitator
