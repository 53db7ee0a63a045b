#pragma once
// Parameters of drawn rigs whose modes differ by a share of their frequency; Stated has it in Hz.
// Thread any; pure.

#include <utility>
#include <vector>

#include "design/drawn_rigs/rig_uncertainty.hpp"

namespace levitas::test {

inline std::vector<uncertainty::Parameter> ModesWithin(
    double share, std::vector<uncertainty::Parameter> parameters) {
  for (uncertainty::Parameter& one : parameters) {
    if (one.kind != uncertainty::Kind::kModeFrequency) continue;
    one.low = (1.0 - share) * one.nominal;
    one.high = (1.0 + share) * one.nominal;
  }
  return parameters;
}

}  // namespace levitas::test
