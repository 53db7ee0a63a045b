#pragma once
// Numbers and hand-made observations for tests of the supervisor.

#include "common/frames.hpp"
#include "controller/supervisor/supervisor.hpp"

namespace levitas::supervisor {

inline RigNumbers TestRig() {
  RigNumbers rig;
  rig.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  rig.bearings = {"de", "nde"};
  rig.period_ns = 100'000;
  rig.clearance_m = 200e-6;
  rig.sensor_range_m = 400e-6;
  rig.max_speed_rad_per_s = 600.0;
  // Of a drive that brings the rotor to any speed within a period: tests set any speed at once.
  rig.max_acceleration_rad_per_s2 = 1e7;
  return rig;
}

inline SupervisorConfig TestConfig() {
  SupervisorConfig config;
  config.sequence = {.self_test_s = 10e-4,
                     .lift_ramp_s = 20e-4,
                     .lift_settle_s = 5e-4,
                     .lift_timeout_s = 100e-4,
                     .settle_radius_m = 20e-6,
                     .landing_ramp_s = 10e-4,
                     .standstill_rad_per_s = 1.0,
                     .standstill_s = 5e-4,
                     .trip_acceleration_rad_per_s2 = 77.0};
  config.protection = {.orbit_fraction = 0.5,
                       .orbit_cycles = 3,
                       .sensor_range_fraction = 0.9,
                       .sensor_range_cycles = 4,
                       .sensor_frozen_cycles = 6,
                       .frame_missing_cycles = 5,
                       .frames_lost_cycles = 12,
                       .frames_lost_window_cycles = 30,
                       .currents_late_cycles = 7,
                       .currents_late_window_cycles = 50,
                       .deadline_missed_cycles = 3,
                       .deadline_window_cycles = 100,
                       .coil_saturated_s = 8e-4,
                       .over_speed_fraction = 1.1};
  return config;
}

/// Observations of a healthy rig; change a field to make it ill. Every reading differs a little
/// from the one before, as noise makes it.
class Seen : public Observation {
 public:
  Seen() {
    fresh = true;
    rig_session = 1;
  }
  const Observation& Next() noexcept {
    ++cycle;
    const double wiggle_m = cycle % 3 == 0 ? -2e-8 : 1e-8;
    for (std::size_t i = 0; i < 4; ++i) {
      if (!frozen[i]) position_m[i] += wiggle_m;
    }
    return *this;
  }
  std::array<bool, 4> frozen{};
};

class Driver {
 public:
  Driver() : supervisor(TestRig(), TestConfig()) {}
  explicit Driver(const SupervisorConfig& config) : supervisor(TestRig(), config) {}
  explicit Driver(const RigNumbers& rig) : supervisor(rig, TestConfig()) {}

  const Decision& Step(Request request = {}) {
    const Observation& observation = seen.Next();
    const Finding finding = supervisor.Check(observation, request);
    return supervisor.Decide(observation, request, finding);
  }
  const Decision& Step(OperatorCommand command) { return Step(Request{command, 300.0, 50.0}); }
  const Decision& Steps(int cycles) {
    for (int i = 0; i < cycles; ++i) (void)Step();
    return supervisor.decision();
  }
  State state() const { return supervisor.decision().state; }

  /// Brings the supervisor into a state by the shortest healthy way.
  void GoTo(State wanted) {
    seen.position_m = {};
    seen.speed_rad_per_s = 0.0;
    if (wanted == State::kOff) return;
    (void)Step(OperatorCommand::kLift);
    if (wanted == State::kSelfTest) return;
    while (state() == State::kSelfTest) (void)Step();
    if (wanted == State::kLift) return;
    while (state() == State::kLift) (void)Step();
    if (wanted == State::kLevitating) return;
    if (wanted == State::kLanding) {
      (void)Step(OperatorCommand::kLand);
      return;
    }
    (void)Step(OperatorCommand::kSpin);
    seen.speed_rad_per_s = 300.0;
    if (wanted == State::kSpinning) return;
    if (wanted == State::kCoastDown) {
      (void)Step(OperatorCommand::kCoastDown);
      return;
    }
    (void)Step(OperatorCommand::kEmergencyStop);
    if (wanted == State::kTrippedStopping) return;
    seen.speed_rad_per_s = 0.0;
    while (state() == State::kTrippedStopping) (void)Step();
    if (wanted == State::kTrippedLanding) return;
    while (state() == State::kTrippedLanding) (void)Step();
  }

  Seen seen;
  Supervisor supervisor;
};

/// A supervisor that has reached `state`, then shows `change` on each further cycle.
template <class Change>
inline Finding TripAfter(State state, int cycles, Change change) {
  Driver driver;
  driver.GoTo(state);
  for (int i = 0; i < cycles; ++i) {
    change(driver.seen, i);
    (void)driver.Step();
  }
  return driver.supervisor.decision().latch.finding;
}

}  // namespace levitas::supervisor
