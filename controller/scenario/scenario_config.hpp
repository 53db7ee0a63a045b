#pragma once
// A scenario: what the operator does, step by step. Times are counted in cycles, so the same
// scenario gives the same commands on every machine.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/enums.hpp"

namespace levitas::scenario {

/// What a step waits for after its command, before its hold time starts.
enum class Wait : std::uint8_t { kNothing, kMode, kSpeedReached, kStandstill };

/// Pseudo-random binary current added to one axis while a step holds; see prbs.hpp.
struct Excitation {
  std::string channel;       ///< "de_x"
  std::size_t axis{};        ///< index of the channel in the rig
  double amplitude_a{};      ///< [A] the current is +amplitude or -amplitude
  int order{};               ///< the sequence repeats after 2^order - 1 bits
  std::uint32_t divisor{1};  ///< control cycles per bit
  double start{};            ///< [1] 0 <= start < 1: where in the sequence it begins
};

struct Step {
  OperatorCommand command{OperatorCommand::kNone};
  double speed_rad_per_s{};          ///< with kSpin
  double acceleration_rad_per_s2{};  ///< with kSpin
  Wait wait{Wait::kNothing};
  Mode wait_mode{Mode::kOff};          ///< with kMode
  double timeout_s{};                  ///< the scenario fails when the wait takes longer
  double hold_s{};                     ///< then stay for this long
  std::vector<Excitation> excitation;  ///< during the hold time
};

struct ScenarioConfig {
  std::string name;
  std::vector<Step> steps;
};

}  // namespace levitas::scenario
