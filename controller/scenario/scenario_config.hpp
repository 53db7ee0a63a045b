#pragma once
// A scenario: what the operator does, step by step. Times are counted in cycles, so the same
// scenario gives the same commands on every machine.

#include <cstdint>
#include <string>
#include <vector>

#include "common/enums.hpp"

namespace levitas::scenario {

/// What a step waits for after its command, before its hold time starts.
enum class Wait : std::uint8_t { kNothing, kMode, kSpeedReached, kStandstill };

struct Step {
  OperatorCommand command{OperatorCommand::kNone};
  double speed_rad_per_s{};          ///< with kSpin
  double acceleration_rad_per_s2{};  ///< with kSpin
  Wait wait{Wait::kNothing};
  Mode wait_mode{Mode::kOff};  ///< with kMode
  double timeout_s{};          ///< the scenario fails when the wait takes longer
  double hold_s{};             ///< then stay for this long
};

struct ScenarioConfig {
  std::string name;
  std::vector<Step> steps;
};

}  // namespace levitas::scenario
