// Protections of the signals on every axis and at both ends of the range: the same event without
// the protection and with it, on the nonlinear plant at speed.

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "controller/law/axis_law.hpp"
#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {
namespace {

constexpr double kSpeedRpm = 3000.0;
// 3000 rpm with the shipped deceleration of 1000 rpm/s is 3 s; half a second for the fall.
constexpr double kStopS = 3.5;

struct Outcome {
  Extremes most;
  Fault fault{};
  int fault_axis{};
  double speed_rpm{};
  bool energised{};
};

Outcome Spinning(Fault kept, const std::function<void(ClosedLoop&)>& event, double time_s) {
  ClosedLoop loop(Only(kept), RollingTouchdownRig());
  if (!loop.Levitate()) ADD_FAILURE() << "no levitation";
  loop.SpinAt(kSpeedRpm);
  event(loop);
  loop.Run(time_s);
  return {loop.most, loop.out.fault, loop.out.fault_axis, loop.speed_rpm(),
          loop.out.current.amplifiers_enabled};
}

void ExpectReleasedAndStopped(const Outcome& with, Fault fault, int axis) {
  EXPECT_EQ(with.fault, fault);
  EXPECT_EQ(with.fault_axis, axis);
  EXPECT_LT(with.speed_rpm, 5.0);
  EXPECT_FALSE(with.energised);
  // Released, the rotor lies in its bearings: 190 um of clearance and, as it falls, at most the
  // 30 um the shipped touchdown bearing gives (see the safe states).
  EXPECT_LT(with.most.shaft_m, 220e-6);
}

void ExpectRunsOnPressedIntoItsBearings(const Outcome& without) {
  EXPECT_EQ(without.fault, Fault::kNone);
  EXPECT_TRUE(without.energised);
  EXPECT_GT(without.speed_rpm, 100.0);  // 3000 rpm, or what friction has left of it
  EXPECT_GT(without.most.contact_n, 100.0);
}

struct Reading {
  int axis;
  double position_m;
};

class StuckAtTheEnd : public testing::TestWithParam<Reading> {};

// A broken cable reads the end of the range; the law answers with all its current.
TEST_P(StuckAtTheEnd, PressesTheRotorIntoItsBearingUnlessReleased) {
  const auto [axis, position_m] = GetParam();
  const auto event = [axis = axis, position_m = position_m](ClosedLoop& loop) {
    loop.disturb = [axis, position_m](cycle::CycleInputs& in) {
      in.frame.position_m[static_cast<std::size_t>(axis)] = position_m;
    };
  };
  const Outcome without = Spinning(Fault::kNone, event, kStopS);
  ExpectRunsOnPressedIntoItsBearings(without);
  const Outcome with = Spinning(Fault::kSensorOutOfRange, event, kStopS);
  ExpectReleasedAndStopped(with, Fault::kSensorOutOfRange, axis);
  EXPECT_LT(with.most.contact_work_j, 0.5 * without.most.contact_work_j);
}

INSTANTIATE_TEST_SUITE_P(EveryAxis, StuckAtTheEnd,
                         testing::Values(Reading{0, -400e-6}, Reading{1, 400e-6},
                                         Reading{2, 400e-6}, Reading{3, -400e-6}));

class FrozenAxis : public testing::TestWithParam<int> {};

// The converter repeats a plausible number: the axis has a force, but no stiffness of its own.
TEST_P(FrozenAxis, FallsOntoItsBearingWithTheMagnetPullingUnlessReleased) {
  const auto axis = static_cast<std::size_t>(GetParam());
  const auto event = [axis](ClosedLoop& loop) {
    const double held_m = loop.plant.SensorOutput()[axis];
    loop.disturb = [axis, held_m](cycle::CycleInputs& in) { in.frame.position_m[axis] = held_m; };
  };
  const Outcome without = Spinning(Fault::kNone, event, kStopS);
  ExpectRunsOnPressedIntoItsBearings(without);
  const Outcome with = Spinning(Fault::kSensorFrozen, event, kStopS);
  ExpectReleasedAndStopped(with, Fault::kSensorFrozen, GetParam());
  EXPECT_LT(with.most.contact_work_j, 0.5 * without.most.contact_work_j);
}

INSTANTIATE_TEST_SUITE_P(EveryAxis, FrozenAxis, testing::Values(0, 1, 2, 3));

// The law alone, as it would be without a supervisor before it. A rig cannot turn a number that is
// none into a current; like the simulated one it keeps the last it could use.
Outcome LawAlone(double glitch_m) {
  const cycle::CycleConfig config = ShippedCycle();
  law::LawConfig law_config = config.law;
  law_config.period_s = config.rig.period_s();
  const law::LawCoefficients law(law_config);
  law::LawState state(law);
  ClosedLoop loop(Only(Fault::kNone), RollingTouchdownRig());
  EXPECT_TRUE(loop.Levitate());
  loop.SpinAt(kSpeedRpm);
  AxisArray usable_a{};
  bool glitch = false;
  bool own_law = false;
  const auto law_step = [&](const AxisArray& position_m) {
    AxisArray error_m{};
    for (std::size_t i = 0; i < 4; ++i) error_m[i] = -position_m[i];
    const AxisArray wanted_a = law::Step(law, state, error_m, {}, 1.0).control_current_a;
    for (std::size_t i = 0; i < 4; ++i) {
      if (std::isfinite(wanted_a[i])) usable_a[i] = wanted_a[i];
    }
  };
  loop.disturb = [&](cycle::CycleInputs& in) {
    AxisArray shown_m = in.frame.position_m;
    if (glitch) shown_m[2] = glitch_m;
    glitch = false;
    law_step(shown_m);
  };
  loop.overrule = [&](plant::PlantCommand& command) {
    if (own_law) command.control_current_a = usable_a;
  };
  loop.Run(0.5);  // both laws see the same rotor; then the lone one takes over
  own_law = true;
  loop.Run(0.5);
  loop.Reset();
  glitch = true;
  loop.Run(kStopS);
  return {loop.most, loop.out.fault, -1, loop.speed_rpm(), true};
}

TEST(NotFinitePair, LawAloneKeepsTheNumberForEverAndTheRotorFalls) {
  EXPECT_EQ(LawAlone(0.0).most.contact_n, 0.0);  // a single zero among the readings is no harm
  const Outcome without = LawAlone(std::numeric_limits<double>::quiet_NaN());
  EXPECT_GT(without.most.contact_n, 100.0);
  EXPECT_GT(without.most.contact_work_j, 1.0);
}

class NotFinite : public testing::TestWithParam<Reading> {};

// One reading that is none, on any axis, with all limits beyond reach: released and stopped.
TEST_P(NotFinite, ReleasesTheRotorInTheSameCycle) {
  const auto [axis, value_m] = GetParam();
  ClosedLoop loop(Only(Fault::kNone), RollingTouchdownRig());
  ASSERT_TRUE(loop.Levitate());
  loop.SpinAt(kSpeedRpm);
  loop.disturb = [axis = axis, value_m = value_m](cycle::CycleInputs& in) {
    in.frame.position_m[static_cast<std::size_t>(axis)] = value_m;
  };
  (void)loop.Step();
  loop.disturb = nullptr;  // one cycle only
  EXPECT_EQ(loop.out.fault, Fault::kSensorNotFinite);
  EXPECT_FALSE(loop.out.current.amplifiers_enabled);
  for (int n = 0; n < 35'000; ++n) {
    (void)loop.Step();
    for (const double current_a : loop.out.current.control_current_a) {
      ASSERT_EQ(current_a, 0.0) << n;
    }
    ASSERT_TRUE(std::isfinite(loop.out.current.speed_set_point_rad_per_s)) << n;
  }
  const Outcome with{loop.most, loop.out.fault, loop.out.fault_axis, loop.speed_rpm(),
                     loop.out.current.amplifiers_enabled};
  ExpectReleasedAndStopped(with, Fault::kSensorNotFinite, axis);
  // And after a reset the law is as new: nothing of the number is left in its memory.
  loop.Command(OperatorCommand::kReset);
  ASSERT_EQ(loop.out.mode, Mode::kOff);
  EXPECT_TRUE(loop.Levitate()) << Name(loop.out.fault);
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
INSTANTIATE_TEST_SUITE_P(EveryReading, NotFinite,
                         testing::Values(Reading{0, kNan}, Reading{1, kInfinity},
                                         Reading{2, -kInfinity}, Reading{3, kNan}));

struct Line {
  const char* name;
  void (*fail)(cycle::CycleInputs& in);
};

class DeadLine : public testing::TestWithParam<Line> {};

// What arrives is not a new frame of this rig: nothing, the last one again, or other axes.
TEST_P(DeadLine, LetsTheRotorGoAfterHalfAMillisecondOfHeldCurrents) {
  const auto event = [fail = GetParam().fail](ClosedLoop& loop) { loop.disturb = fail; };
  ExpectRunsOnPressedIntoItsBearings(Spinning(Fault::kNone, event, kStopS));
  ExpectReleasedAndStopped(Spinning(Fault::kFrameMissing, event, kStopS), Fault::kFrameMissing, -1);
}

INSTANTIATE_TEST_SUITE_P(
    EveryKind, DeadLine,
    testing::Values(Line{"Silence", [](cycle::CycleInputs& in) { in.frame_present = false; }},
                    Line{"SameFrameAgain", [](cycle::CycleInputs& in) { in.frame.cycle = 7; }},
                    Line{"OtherAxes", [](cycle::CycleInputs& in) { in.frame.axes = 2; }}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace levitas::test
