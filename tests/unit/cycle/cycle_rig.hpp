#pragma once
// A cycle for the flexible rotor's numbers and a rig made of constants, for tests without a plant.

#include <cstdint>

#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "tests/unit/law/flexible_rotor_law.hpp"

namespace levitas::cycle {

inline CycleConfig FlexibleRotorCycle() {
  CycleConfig config;
  RigNumbers& rig = config.rig;
  rig.name = "flexible_rotor";
  rig.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  rig.bearings = {"de", "nde"};
  rig.period_ns = 100'000;
  rig.bias_current_a = 1.0;
  rig.max_coil_current_a = 2.0;
  rig.clearance_m = 190e-6;
  rig.sensor_range_m = 400e-6;
  rig.max_speed_rad_per_s = RpmToRadPerS(6000.0);
  rig.sensor_polarity = {1, 1, 1, 1};
  rig.actuator_polarity = {1, 1, 1, 1};
  rig.standing_orbit_objective_m = 7e-6;
  rig.spinning_orbit_objective_m = 36e-6;
  config.law = law::FlexibleRotorLaw();
  config.supervisor.sequence = {.self_test_s = 0.05,
                                .lift_ramp_s = 0.5,
                                .lift_settle_s = 0.1,
                                .lift_timeout_s = 3.0,
                                .settle_radius_m = 20e-6,
                                .landing_ramp_s = 0.5,
                                .standstill_rad_per_s = 1.0,
                                .standstill_s = 0.02,
                                .trip_acceleration_rad_per_s2 = 100.0};
  config.supervisor.protection = {.orbit_fraction = 0.6,
                                  .orbit_cycles = 3,
                                  .sensor_range_fraction = 0.95,
                                  .sensor_range_cycles = 3,
                                  .sensor_frozen_cycles = 20,
                                  .frame_missing_cycles = 10,
                                  .deadline_missed_cycles = 5,
                                  .deadline_window_cycles = 1000,
                                  .coil_saturated_s = 0.05,
                                  .over_speed_fraction = 1.1};
  return config;
}

/// A rig whose rotor stays where it is put, read with a little noise so that it looks alive.
class StillRig {
 public:
  AxisArray position_m{-134e-6, -134e-6, -134e-6, -134e-6};
  double speed_rad_per_s{};
  std::uint32_t session{7};
  std::uint32_t status{};
  double noise_m{1e-6};

  [[nodiscard]] CycleInputs Next(OperatorCommand command = OperatorCommand::kNone) {
    CycleInputs in;
    in.cycle = cycle_;
    in.frame_present = true;
    in.frame.cycle = cycle_++;
    in.frame.rig_session = session;
    in.frame.rig_status = status;
    in.frame.axes = 4;
    for (std::size_t i = 0; i < 4; ++i) {
      in.frame.position_m[i] = position_m[i] + noise_m * random_.Normal();
    }
    in.frame.speed_rad_per_s = speed_rad_per_s;
    in.op.command = command;
    return in;
  }

 private:
  std::uint64_t cycle_{};
  Random random_{20261121};
};

/// Steps until `mode` is reached, at most `cycles`; returns the last outputs.
inline CycleOutputs StepUntil(ControlCycle& control, StillRig& rig, Mode mode,
                              std::size_t cycles = 100'000) {
  CycleOutputs out;
  for (std::size_t i = 0; i < cycles; ++i) {
    out = control.Step(rig.Next());
    if (out.mode == mode) break;
  }
  return out;
}

/// Off -> levitating: the rotor is moved to the centre by hand while the lift waits for it.
inline CycleOutputs Levitate(ControlCycle& control, StillRig& rig) {
  (void)control.Step(rig.Next(OperatorCommand::kLift));
  CycleOutputs out = StepUntil(control, rig, Mode::kLift);
  rig.position_m = {};
  return out.mode == Mode::kLift ? StepUntil(control, rig, Mode::kLevitating) : out;
}

}  // namespace levitas::cycle
