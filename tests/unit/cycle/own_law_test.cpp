// A law of one's own in the cycle: what reaches it, and that limit and protections hold for it.

#include "controller/law/own_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "tests/support/allocation_guard.hpp"
#include "tests/unit/cycle/cycle_rig.hpp"

namespace levitas::cycle {
namespace {

/// What the law was told and shall answer; the test keeps it while the cycle owns the law.
struct Talk {
  int starts{};
  law::LawInputs heard;
  AxisArray answer_a{};
};

class ToldLaw final : public law::OwnLaw {
 public:
  explicit ToldLaw(Talk& talk) : talk_(talk) {}
  void Start() noexcept override { ++talk_.starts; }
  [[nodiscard]] AxisArray Step(const law::LawInputs& in) noexcept override {
    talk_.heard = in;
    return talk_.answer_a;
  }

 private:
  Talk& talk_;
};

ControlCycle WithToldLaw(Talk& talk, CycleConfig config = FlexibleRotorCycle()) {
  config.law.axes.clear();  // no law of a file stands behind it
  return {config, std::make_unique<ToldLaw>(talk)};
}

TEST(OwnLaw, ReadsErrorsOfTheBearingFrameAndDrivesTheCoilsAsTheyAreWired) {
  CycleConfig config = FlexibleRotorCycle();
  config.rig.sensor_polarity = {-1, 1, 1, 1};
  config.rig.actuator_polarity = {1, -1, 1, 1};
  Talk talk;
  talk.answer_a = {0.25, 0.5, -0.125, 0.0};
  ControlCycle control = WithToldLaw(talk, config);
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  rig.noise_m = 0.0;
  rig.position_m = {10e-6, 20e-6, -30e-6, 0.0};
  const CycleOutputs out = control.Step(rig.Next());
  EXPECT_EQ(talk.heard.axes, 4U);
  EXPECT_EQ(talk.heard.limit_a, 1.0);  // bias 1 A, coils 0 to 2 A
  EXPECT_DOUBLE_EQ(talk.heard.error_m[0], 10e-6);
  EXPECT_DOUBLE_EQ(talk.heard.error_m[1], -20e-6);
  EXPECT_DOUBLE_EQ(talk.heard.error_m[2], 30e-6);
  EXPECT_EQ(out.current.control_current_a, (AxisArray{0.25, -0.5, -0.125, 0.0}));
  EXPECT_EQ(out.current.bias_current_a, 1.0);
}

TEST(OwnLaw, StartsAnewWithEveryLiftAndIsNotAskedWithoutAFrame) {
  Talk talk;
  ControlCycle control = WithToldLaw(talk);
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  EXPECT_EQ(talk.starts, 1);
  talk.answer_a = {0.5};
  (void)control.Step(rig.Next());
  talk.answer_a = {0.75};
  CycleInputs silent = rig.Next();
  silent.frame_present = false;
  EXPECT_EQ(control.Step(silent).current.control_current_a[0], 0.5);  // the last one is held
  ASSERT_EQ(control.Step(rig.Next(OperatorCommand::kEmergencyStop)).mode, Mode::kTripped);
  ASSERT_EQ(StepUntil(control, rig, Mode::kOff, 20'000).mode, Mode::kTripped);
  ASSERT_FALSE(control.Step(rig.Next(OperatorCommand::kReset)).command_refused);
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  EXPECT_EQ(talk.starts, 2);
}

TEST(OwnLaw, IsLimitedAndAnAxisThatStaysAtTheLimitTrips) {
  Talk talk;
  ControlCycle control = WithToldLaw(talk);
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  talk.answer_a = {0.0, 7.0, 0.0, -1.0};
  CycleOutputs out = control.Step(rig.Next());
  EXPECT_EQ(out.current.control_current_a, (AxisArray{0.0, 1.0, 0.0, -1.0}));
  EXPECT_EQ(out.saturated_axes, 1U << 1);  // what wants just the limit is not beyond it
  for (int n = 0; n < 1000 && out.mode != Mode::kTripped; ++n) out = control.Step(rig.Next());
  EXPECT_EQ(out.fault, Fault::kCoilSaturated);
  EXPECT_EQ(out.fault_axis, 1);
}

TEST(OwnLaw, TestSignalsAreAddedToWhatItWants) {
  Talk talk;
  talk.answer_a = {0.5, 0.9};
  ControlCycle control = WithToldLaw(talk);
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  CycleInputs in = rig.Next();
  in.op.excitation_a = {0.25, 0.25};
  const CycleOutputs out = control.Step(in);
  EXPECT_EQ(out.current.control_current_a, (AxisArray{0.75, 1.0}));
  EXPECT_EQ(out.saturated_axes, 1U << 1);
}

TEST(OwnLaw, WhatIsNoNumberReleasesTheRotorInTheSameCycle) {
  Talk talk;
  ControlCycle control = WithToldLaw(talk);
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  talk.answer_a = {0.1, 0.1, std::numeric_limits<double>::quiet_NaN(), 0.1};
  const CycleOutputs out = control.Step(rig.Next());
  EXPECT_EQ(out.fault, Fault::kLawNotFinite);
  EXPECT_EQ(out.fault_axis, 2);
  EXPECT_EQ(out.current.control_current_a, AxisArray{});
  EXPECT_FALSE(out.current.amplifiers_enabled);
}

TEST(OwnLaw, TheCycleAroundItAllocatesNothing) {
  Talk talk;
  ControlCycle control = WithToldLaw(talk);
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  const CycleInputs in = rig.Next();
  const test::AllocationGuard guard;
  (void)control.Step(in);
  EXPECT_EQ(guard.count(), 0U);
}

TEST(OwnLaw, NoneIsRefusedAndSoIsARigWithoutAxes) {
  EXPECT_THROW((ControlCycle{FlexibleRotorCycle(), nullptr}), std::invalid_argument);
  Talk talk;
  CycleConfig config = FlexibleRotorCycle();
  config.rig.channels.clear();
  EXPECT_THROW(WithToldLaw(talk, config), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::cycle
