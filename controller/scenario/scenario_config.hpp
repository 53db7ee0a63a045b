#pragma once
// A scenario: what the operator does, step by step. Times are counted in cycles, so the same
// scenario gives the same commands on every machine.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/enums.hpp"
#include "common/rig_events.hpp"

namespace levitas::scenario {

/// What a step waits for after its command, before its hold time starts.
enum class Wait : std::uint8_t { kNothing, kMode, kSpeedReached, kStandstill };

/// Where an excitation enters the loop.
enum class Injection : std::uint8_t {
  kControlCurrent,    ///< added to the law's current, before its limit
  kMeasuredPosition,  ///< added to what the law reads of the sensor; protections read the sensor
};

/// See signal.hpp.
enum class SignalKind : std::uint8_t { kPrbs, kPaprbs, kSteppedSine, kChirp, kMultisine, kImpulse };

/// Test signal on one axis while a step holds. Of the fields below `point` those count that the
/// kind needs.
struct Excitation {
  std::string channel;       ///< "de_x"
  std::size_t axis{};        ///< index of the channel in the rig
  double amplitude_a{};      ///< [A] peak, at the control current
  int order{};               ///< the sequence repeats after 2^order - 1 bits
  std::uint32_t divisor{1};  ///< control cycles per bit
  double start{};            ///< [1] 0 <= start < 1: where in the sequence it begins
  double amplitude_m{};      ///< [m] peak, at the measured position
  Injection point{Injection::kControlCurrent};
  SignalKind kind{SignalKind::kPrbs};
  double low_share{};     ///< [1] least amplitude of a bit, of the peak
  std::uint64_t seed{1};  ///< of the bits' amplitudes
  double from_hz{};
  double to_hz{};
  bool linear{};                ///< frequencies spaced evenly; else by equal ratios
  std::uint32_t frequencies{};  ///< of a stepped sine
  double dwell_s{};             ///< on each of them
  double repeat_s{};            ///< one sweep, one period; 0 with an impulse: once
  double width_s{};             ///< of an impulse
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
  double orbit_limit_m{};              ///< the excitation is cut back beyond it; 0: never
};

struct ScenarioConfig {
  std::string name;
  std::vector<Step> steps;
  std::vector<ScheduledRigEvent>
      rig_events;  ///< for the simulated rig; the player does not look at them
};

}  // namespace levitas::scenario
