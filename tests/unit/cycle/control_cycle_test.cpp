#include "controller/cycle/control_cycle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "controller/law/axis_law.hpp"
#include "tests/unit/cycle/cycle_rig.hpp"

namespace levitas::cycle {
namespace {

TEST(ControlCycle, LiftsSpinsCoastsAndLandsAsTheTableSays) {
  ControlCycle control(FlexibleRotorCycle());
  StillRig rig;
  EXPECT_EQ(control.Step(rig.Next()).mode, Mode::kOff);
  EXPECT_EQ(control.Step(rig.Next(OperatorCommand::kLift)).mode, Mode::kSelfTest);
  CycleOutputs out = Levitate(control, rig);
  ASSERT_EQ(out.mode, Mode::kLevitating) << Name(out.fault);
  CycleInputs spin = rig.Next(OperatorCommand::kSpin);
  spin.op.speed_rad_per_s = 300.0;
  spin.op.acceleration_rad_per_s2 = 50.0;
  out = control.Step(spin);
  EXPECT_EQ(out.mode, Mode::kSpinning);
  EXPECT_TRUE(out.current.drive_enabled);
  EXPECT_EQ(out.current.speed_set_point_rad_per_s, 300.0);
  EXPECT_EQ(out.current.acceleration_limit_rad_per_s2, 50.0);
  rig.speed_rad_per_s = 300.0;
  EXPECT_EQ(control.Step(rig.Next(OperatorCommand::kCoastDown)).mode, Mode::kCoastDown);
  EXPECT_FALSE(control.Step(rig.Next()).current.drive_enabled);
  rig.speed_rad_per_s = 0.0;
  EXPECT_EQ(control.Step(rig.Next()).mode, Mode::kCoastDown);
  EXPECT_EQ(StepUntil(control, rig, Mode::kLevitating, 199).mode, Mode::kLevitating);  // 20 ms
  out = control.Step(rig.Next(OperatorCommand::kLand));
  EXPECT_EQ(out.mode, Mode::kLanding);
  for (int n = 0; n < 6000 && out.mode == Mode::kLanding; ++n) {
    rig.position_m = out.reference_m;
    out = control.Step(rig.Next());
  }
  EXPECT_EQ(out.mode, Mode::kOff) << Name(out.fault);
  EXPECT_FALSE(out.current.amplifiers_enabled);
  EXPECT_EQ(out.current.bias_current_a, 0.0);
}

/// Currents of a rotor held at 10 um at full speed, from where on `fault` is read instead of it.
std::vector<double> CurrentsWithSpeedRead(double fault) {
  CycleConfig config = FlexibleRotorCycle();
  config.rig.max_acceleration_rad_per_s2 = 50.0;
  law::LawAtSpeed fast{config.rig.max_speed_rad_per_s, config.law.axes, {}};
  for (law::AxisLawConfig& axis : fast.axes) axis.kp_a_per_m *= 1.5;
  config.law.schedule = {fast};
  ControlCycle control(config);
  StillRig rig;
  EXPECT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  CycleInputs spin = rig.Next(OperatorCommand::kSpin);
  spin.op.speed_rad_per_s = config.rig.max_speed_rad_per_s;
  spin.op.acceleration_rad_per_s2 = 50.0;
  (void)control.Step(spin);
  while (rig.speed_rad_per_s < config.rig.max_speed_rad_per_s) {
    rig.speed_rad_per_s += 0.005;
    (void)control.Step(rig.Next());
  }
  rig.position_m = {10e-6, 10e-6, 10e-6, 10e-6};
  for (int n = 0; n < 300; ++n) (void)control.Step(rig.Next());
  rig.speed_rad_per_s = fault;
  std::vector<double> currents;
  for (int n = 0; n < 90; ++n) {
    currents.push_back(control.Step(rig.Next()).current.control_current_a[0]);
  }
  return currents;
}

// A tachometer that is lost at full speed must not bring the law of rest with it.
TEST(ControlCycle, KeepsTheLawOfTheBelievedSpeedWhenTheReadingIsLost) {
  const double top = FlexibleRotorCycle().rig.max_speed_rad_per_s;
  const std::vector<double> held = CurrentsWithSpeedRead(top);
  EXPECT_EQ(CurrentsWithSpeedRead(0.0), held);
  EXPECT_EQ(CurrentsWithSpeedRead(std::numeric_limits<double>::quiet_NaN()), held);
  // A change that the drive can make is followed, within the margin of the belief: 1 % and a bit.
  EXPECT_NE(CurrentsWithSpeedRead(top - 6.0), held);
}

TEST(ControlCycle, HoldsTheLastCurrentWhileFramesAreMissingThenDrops) {
  const CycleConfig config = FlexibleRotorCycle();
  ControlCycle control(config);
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  const CycleOutputs before = control.Step(rig.Next());
  const std::uint32_t allowed = config.supervisor.protection.frame_missing_cycles;
  for (std::uint32_t i = 1; i < allowed; ++i) {
    CycleInputs in = rig.Next();
    in.frame_present = false;
    const CycleOutputs held = control.Step(in);
    ASSERT_EQ(held.mode, Mode::kLevitating);
    ASSERT_EQ(held.current.control_current_a, before.current.control_current_a);
  }
  CycleInputs in = rig.Next();
  in.frame_present = false;
  const CycleOutputs dropped = control.Step(in);
  EXPECT_EQ(dropped.fault, Fault::kFrameMissing);
  EXPECT_EQ(dropped.current.bias_current_a, 0.0);
  EXPECT_EQ(dropped.current.control_current_a, AxisArray{});
}

// Frames that overtake each other on their way: the older one says nothing new.
TEST(ControlCycle, TakesAFrameOlderThanTheLastForNoFrameUnlessTheRigHasStartedAnew) {
  ControlCycle control(FlexibleRotorCycle());
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  const CycleInputs overtaken = rig.Next();
  const CycleOutputs before = control.Step(rig.Next());
  CycleInputs in = overtaken;
  in.cycle += 2;
  in.frame.position_m[0] = 50e-6;
  const CycleOutputs held = control.Step(in);
  EXPECT_EQ(held.current.control_current_a, before.current.control_current_a);
  EXPECT_EQ(held.current.cycle, before.current.cycle);
  in.frame.rig_session += 1;
  in.cycle += 1;
  EXPECT_EQ(control.Step(in).fault, Fault::kRigRestarted);
}

TEST(ControlCycle, TakesAStopOfTheChainWithoutAFrame) {
  ControlCycle control(FlexibleRotorCycle());
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  CycleInputs in = rig.Next();
  in.frame_present = false;
  in.frame.rig_status = kRigEmergencyStop | kRigAmplifierFault;  // only the chain has its own line
  const CycleOutputs stopped = control.Step(in);
  EXPECT_EQ(stopped.fault, Fault::kEmergencyStop);
  EXPECT_TRUE(stopped.current.amplifiers_enabled) << "a levitated stop";
}

TEST(ControlCycle, UndoesPolarityOnceOnEachSide) {
  const CycleConfig straight = FlexibleRotorCycle();
  CycleConfig wired = straight;
  wired.rig.sensor_polarity = {-1, 1, -1, 1};
  wired.rig.actuator_polarity = {1, -1, -1, 1};
  ControlCycle one(straight);
  ControlCycle other(wired);
  StillRig rig;
  bool energised = false;
  for (int i = 0; i < 3000; ++i) {
    CycleInputs in = rig.Next(i == 1 ? OperatorCommand::kLift : OperatorCommand::kNone);
    const CycleOutputs expected = one.Step(in);
    for (std::size_t a = 0; a < 4; ++a) in.frame.position_m[a] *= wired.rig.sensor_polarity[a];
    const CycleOutputs found = other.Step(in);
    for (std::size_t a = 0; a < 4; ++a) {
      ASSERT_EQ(found.current.control_current_a[a],
                wired.rig.actuator_polarity[a] * expected.current.control_current_a[a]);
    }
    energised = energised || expected.current.control_current_a[0] != 0.0;
  }
  EXPECT_TRUE(energised);
}

// A state that grows where no current shows it: 0 x infinity is in the end in every current.
law::StateSpaceConfig HiddenGrowth() {
  law::StateSpaceConfig law;
  law.axes = 4;
  law.discrete = true;
  law::ModalBlock block;
  block.pole_real = 1.05;  // overflows after some 14 500 periods: ln(1.8e308)/ln(1.05)
  block.first_input = {1.0, 0.0, 0.0, 0.0};
  law.blocks = {block};
  law.input_v_per_m = {1.0, 1.0, 1.0, 1.0};
  law.output_a_per_v = {1.0, 1.0, 1.0, 1.0};
  for (std::size_t i = 0; i < 4; ++i) law.direct[i][i] = -1e3;
  return law;
}

// Beyond the converter's range a number means nothing: the law takes the end of the range. A law
// that is only a gain of 1000 A/m, so that 400 um ask for 0.4 A of the 1 A there is.
TEST(ControlCycle, TakesAPositionBeyondTheRangeOfItsSensorForTheEndOfTheRange) {
  const auto current = [](double position_m) {
    CycleConfig config = FlexibleRotorCycle();
    config.law = {};
    config.law.state_space = HiddenGrowth();
    config.law.state_space->blocks.clear();
    ControlCycle control(config);
    StillRig rig;
    EXPECT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
    CycleInputs in = rig.Next();
    in.frame.position_m[1] = position_m;
    return std::abs(control.Step(in).current.control_current_a[1]);
  };
  // 1e-12 A: rounding of the product.
  EXPECT_NEAR(current(300e-6), 0.3, 1e-12);
  EXPECT_NEAR(current(400e-6), 0.4, 1e-12);
  EXPECT_NEAR(current(700e-6), 0.4, 1e-12);
  EXPECT_NEAR(current(-1e30), 0.4, 1e-12);
}

TEST(LawNotFinitePair, AnUncheckedLawOfHiddenGrowthCommandsNoNumberOnEveryAxis) {
  law::LawConfig config;
  config.state_space = HiddenGrowth();
  config.period_s = 1e-4;
  const law::LawCoefficients coefficients(config);
  law::LawState state(coefficients);
  law::LawOutput out;
  for (int n = 0; n < 16'000; ++n) out = law::Step(coefficients, state, {1e-5}, {}, 1.0);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(std::isnan(out.control_current_a[i])) << i;
}

TEST(LawNotFinitePair, TheCycleReleasesTheRotorAndNeverCommandsIt) {
  CycleConfig config = FlexibleRotorCycle();
  config.law = {};
  config.law.state_space = HiddenGrowth();
  ControlCycle control(config);
  StillRig rig;
  CycleOutputs out = Levitate(control, rig);
  for (int n = 0; n < 16'000 && out.fault == Fault::kNone; ++n) {
    out = control.Step(rig.Next());
    for (const double current_a : out.current.control_current_a) {
      ASSERT_TRUE(std::isfinite(current_a)) << n;
    }
  }
  EXPECT_EQ(out.fault, Fault::kLawNotFinite);
  EXPECT_EQ(out.mode, Mode::kTripped);
  EXPECT_EQ(out.current.control_current_a, AxisArray{});
  EXPECT_EQ(out.current.bias_current_a, 0.0);
  EXPECT_FALSE(out.current.amplifiers_enabled);
}

// The harm: one NaN let through to the law stays in its filters for ever.
TEST(NotFinitePair, OneNanPoisonsAnUnguardedLaw) {
  const law::LawCoefficients coefficients(law::FlexibleRotorLaw());
  law::LawState state(coefficients);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  (void)law::Step(coefficients, state, {nan}, {}, 1.0);
  for (int n = 0; n < 1000; ++n) (void)law::Step(coefficients, state, {}, {}, 1.0);
  EXPECT_TRUE(std::isnan(state.integral_a.at[0]));
}

TEST(NotFinitePair, TheCycleReleasesInTheSameCycleAndLevitatesAgainAfterReset) {
  ControlCycle control(FlexibleRotorCycle());
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  CycleInputs bad = rig.Next();
  bad.frame.position_m[2] = std::numeric_limits<double>::quiet_NaN();
  const CycleOutputs out = control.Step(bad);
  EXPECT_EQ(out.fault, Fault::kSensorNotFinite);
  EXPECT_EQ(out.fault_axis, 2);
  EXPECT_EQ(out.current.control_current_a, AxisArray{});
  EXPECT_EQ(out.current.bias_current_a, 0.0);
  EXPECT_FALSE(out.current.amplifiers_enabled);
  EXPECT_FALSE(control.Step(rig.Next(OperatorCommand::kReset)).command_refused);
  EXPECT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
}

TEST(ControlCycle, RefusesConfigurationsThatDoNotFit) {
  CycleConfig config = FlexibleRotorCycle();
  config.law.axes.pop_back();
  EXPECT_THROW(ControlCycle{config}, std::invalid_argument);
  config = FlexibleRotorCycle();
  config.rig.sensor_polarity[2] = 0.0;
  EXPECT_THROW(ControlCycle{config}, std::invalid_argument);
  config = FlexibleRotorCycle();
  config.law.period_s = 5e-5;
  EXPECT_THROW(ControlCycle{config}, std::invalid_argument);
  config = FlexibleRotorCycle();
  config.rig.max_coil_current_a = 1.0;
  EXPECT_THROW(ControlCycle{config}, std::invalid_argument);
  config = FlexibleRotorCycle();
  config.supervisor.protection.orbit_fraction = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ControlCycle{config}, std::invalid_argument);
}

}  // namespace
}  // namespace levitas::cycle
