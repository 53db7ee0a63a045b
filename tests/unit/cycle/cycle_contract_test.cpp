// What holds for any input: bounded currents, no NaN, same bits, no allocation, in every mode.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <vector>

#include "controller/supervisor/supervisor.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/unit/cycle/cycle_rig.hpp"

namespace levitas::cycle {
namespace {

using supervisor::State;

CycleOutputs Spin(ControlCycle& control, StillRig& rig) {
  CycleInputs in = rig.Next(OperatorCommand::kSpin);
  in.op.speed_rad_per_s = 300.0;
  in.op.acceleration_rad_per_s2 = 50.0;
  rig.speed_rad_per_s = 300.0;
  return control.Step(in);
}

// Brings a cycle into the state by the shortest way and leaves the rig so that it stays there.
void GoTo(State wanted, ControlCycle& control, StillRig& rig) {
  if (wanted == State::kOff) return;
  (void)control.Step(rig.Next(OperatorCommand::kLift));
  if (wanted == State::kSelfTest) return;
  (void)StepUntil(control, rig, Mode::kLift);
  if (wanted == State::kLift) return;
  rig.position_m = {};
  (void)StepUntil(control, rig, Mode::kLevitating);
  if (wanted == State::kLevitating) return;
  if (wanted == State::kLanding) {
    (void)control.Step(rig.Next(OperatorCommand::kLand));
    return;
  }
  (void)Spin(control, rig);
  if (wanted == State::kSpinning) return;
  if (wanted == State::kCoastDown) {
    (void)control.Step(rig.Next(OperatorCommand::kCoastDown));
    return;
  }
  (void)control.Step(rig.Next(OperatorCommand::kEmergencyStop));
  if (wanted == State::kTrippedStopping) return;
  rig.speed_rad_per_s = 0.0;
  while (control.decision().state == State::kTrippedStopping) (void)control.Step(rig.Next());
  if (wanted == State::kTrippedLanding) return;
  rig.status = kRigAmplifierFault;
  (void)control.Step(rig.Next());
}

TEST(ControlCycle, AllocatesNothingIn10000CyclesOfEveryState) {
  for (std::size_t i = 0; i < supervisor::kStateCount; ++i) {
    const auto state = static_cast<State>(i);
    CycleConfig config = FlexibleRotorCycle();
    config.supervisor.sequence.self_test_s = 10.0;  // long enough to stay for 10 000 cycles
    config.supervisor.sequence.lift_timeout_s = 10.0;
    config.supervisor.sequence.landing_ramp_s = 10.0;
    // Getting there must not take that long.
    if (state != State::kSelfTest) config.supervisor.sequence.self_test_s = 0.01;
    ControlCycle control(config);
    StillRig rig;
    GoTo(state, control, rig);
    ASSERT_EQ(control.decision().state, state);
    const test::AllocationGuard guard;
    for (int n = 0; n < 10'000; ++n) {
      CycleInputs in = rig.Next();
      in.frame_present = n % 7 != 0;
      in.op.excitation_a = {0.01, 0.01, 0.01, 0.01};
      (void)control.Step(in);
    }
    EXPECT_EQ(guard.count(), 0U) << Name(state);
    EXPECT_EQ(control.decision().state, state);
  }
}

double Wild(Random& random) {
  switch (random.Bits() % 16) {
    case 0:
      return std::numeric_limits<double>::quiet_NaN();
    case 1:
      return random.Uniform() < 0.5 ? HUGE_VAL : -HUGE_VAL;
    case 2:
      return (random.Uniform() - 0.5) * 1e308;
    case 3:
      return 1.0;
    default:
      return 200e-6 * random.Normal();
  }
}

CycleInputs WildInputs(Random& random, std::uint64_t cycle) {
  CycleInputs in;
  in.cycle = cycle;
  in.frame_present = random.Uniform() < 0.98;
  in.frame.cycle = random.Uniform() < 0.99 ? cycle : cycle / 2;
  in.frame.axes = random.Uniform() < 0.999 ? 4 : 3;
  in.frame.rig_session = random.Uniform() < 0.9995 ? 1 : 2;
  in.frame.rig_status = random.Uniform() < 0.999 ? 0 : static_cast<std::uint32_t>(random.Bits());
  const bool wild = random.Uniform() < 0.002;
  for (double& position_m : in.frame.position_m) {
    position_m = wild ? Wild(random) : 60e-6 * random.Normal();
  }
  in.frame.speed_rad_per_s = wild ? Wild(random) : 0.0;
  in.missed_deadlines = random.Uniform() < 0.001 ? static_cast<std::uint32_t>(random.Bits()) : 0;
  if (random.Uniform() < 0.05) in.op.command = static_cast<OperatorCommand>(random.Bits() % 9);
  if (random.Uniform() < 0.5 && in.op.command == OperatorCommand::kEmergencyStop) {
    in.op.command = OperatorCommand::kLift;
  }
  in.op.speed_rad_per_s = random.Uniform() < 0.5 ? 0.0 : Wild(random);
  in.op.acceleration_rad_per_s2 = random.Uniform() < 0.5 ? 10.0 : Wild(random);
  for (double& excitation_a : in.op.excitation_a) excitation_a = Wild(random) * 1e3;
  return in;
}

CycleConfig ImpatientCycle() {
  CycleConfig config = FlexibleRotorCycle();
  config.supervisor.sequence.self_test_s = 5e-4;
  config.supervisor.sequence.lift_ramp_s = 5e-4;
  config.supervisor.sequence.lift_settle_s = 1e-4;
  config.supervisor.sequence.settle_radius_m = 150e-6;
  config.supervisor.sequence.landing_ramp_s = 1e-3;
  config.supervisor.protection.orbit_cycles = 40;
  return config;
}

TEST(ControlCycle, KeepsBothCoilsInRangeForAnyInput) {
  const CycleConfig config = ImpatientCycle();
  ControlCycle control(config);
  Random random(20261121);
  std::set<Mode> modes;
  std::set<Fault> faults;
  for (std::uint64_t n = 0; n < 100'000; ++n) {
    const CycleOutputs out = control.Step(WildInputs(random, n));
    modes.insert(out.mode);
    faults.insert(out.fault);
    for (std::size_t i = 0; i < kMaxAxes; ++i) {
      const double ic_a = out.current.control_current_a[i];
      ASSERT_GE(out.current.bias_current_a - std::abs(ic_a), 0.0) << n;  // false for NaN, too
      ASSERT_LE(out.current.bias_current_a + std::abs(ic_a), config.rig.max_coil_current_a) << n;
      ASSERT_TRUE(std::isfinite(out.reference_m[i]));
    }
    ASSERT_TRUE(std::isfinite(out.current.speed_set_point_rad_per_s));
    ASSERT_TRUE(std::isfinite(out.current.acceleration_limit_rad_per_s2));
    ASSERT_FALSE(std::isnan(out.fault_value));
    ASSERT_FALSE(std::isnan(out.fault_limit));
  }
  // The inputs are worth something only if they led into most modes and faults.
  EXPECT_EQ(modes.size(), kModeCount);
  EXPECT_GE(faults.size(), 7U);
}

TEST(ControlCycle, GivesTheSameBitsForTheSameInputs) {
  ControlCycle one(ImpatientCycle());
  ControlCycle other(ImpatientCycle());
  Random random(4);
  for (std::uint64_t n = 0; n < 50'000; ++n) {
    const CycleInputs in = WildInputs(random, n);
    const CycleOutputs a = one.Step(in);
    const CycleOutputs b = other.Step(in);
    ASSERT_EQ(
        std::memcmp(&a.current.control_current_a, &b.current.control_current_a, sizeof(AxisArray)),
        0);
    ASSERT_EQ(a.mode, b.mode);
    ASSERT_EQ(a.fault, b.fault);
    ASSERT_EQ(a.reference_m, b.reference_m);
    ASSERT_EQ(a.command_refused, b.command_refused);
  }
}

TEST(ControlCycle, StartsEveryLiftWithAnEmptyMemory) {
  // Two cycles, one with a past full of large errors: the next lift is the same bit for bit.
  ControlCycle used(FlexibleRotorCycle());
  StillRig past;
  ASSERT_EQ(Levitate(used, past).mode, Mode::kLevitating);
  past.position_m = {80e-6, 0, -70e-6, 0};
  for (int n = 0; n < 100; ++n) (void)used.Step(past.Next());
  past.status = kRigAmplifierFault;
  (void)used.Step(past.Next());
  past.status = 0;
  ASSERT_EQ(used.Step(past.Next(OperatorCommand::kReset)).mode, Mode::kOff);
  ControlCycle fresh(FlexibleRotorCycle());
  StillRig rig;
  for (int n = 0; n < 2000; ++n) {
    CycleInputs in = rig.Next(n == 1 ? OperatorCommand::kLift : OperatorCommand::kNone);
    in.frame.rig_session = 99;  // a rig neither has seen
    ASSERT_EQ(used.Step(in).current.control_current_a, fresh.Step(in).current.control_current_a);
  }
}

TEST(ControlCycle, LetsExcitationThroughOnlyWhereTheTableSays) {
  for (std::size_t i = 0; i < supervisor::kStateCount; ++i) {
    const auto state = static_cast<State>(i);
    ControlCycle with(FlexibleRotorCycle());
    ControlCycle without(FlexibleRotorCycle());
    StillRig rig;
    StillRig same;
    // In the centre all the time and quiet, so far from the limit: the difference is the
    // excitation.
    rig.position_m = same.position_m = {};
    rig.noise_m = same.noise_m = 1e-9;
    GoTo(state, with, rig);
    GoTo(state, without, same);
    CycleInputs in = rig.Next();
    const CycleOutputs plain = without.Step(in);
    in.op.excitation_a = {0.0, 0.125, 0.0, std::numeric_limits<double>::quiet_NaN()};
    const CycleOutputs excited = with.Step(in);
    const double added = excited.current.control_current_a[1] - plain.current.control_current_a[1];
    // 0.125 is a power of two: added to currents below 1 A it leaves at most a rounding of 2^-53.
    EXPECT_NEAR(added, supervisor::Row(state).excitation ? 0.125 : 0.0, 1e-15) << Name(state);
    EXPECT_EQ(excited.current.control_current_a[3], plain.current.control_current_a[3]);
  }
}

TEST(ControlCycle, TakesARepeatedOrForeignFrameForAMissingOne) {
  ControlCycle control(FlexibleRotorCycle());
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  CycleInputs stale = rig.Next();
  CycleOutputs out = control.Step(stale);
  for (int n = 0; n < 9; ++n) {
    ++stale.cycle;
    EXPECT_EQ(control.Step(stale).current.control_current_a, out.current.control_current_a);
  }
  ++stale.cycle;
  EXPECT_EQ(control.Step(stale).fault, Fault::kFrameMissing);
  ControlCycle other(FlexibleRotorCycle());
  StillRig six;
  ASSERT_EQ(Levitate(other, six).mode, Mode::kLevitating);
  for (int n = 0; n < 10; ++n) {
    CycleInputs in = six.Next();
    in.frame.axes = 6;
    out = other.Step(in);
  }
  EXPECT_EQ(out.fault, Fault::kFrameMissing);
}

class Recorder : public StageObserver {
 public:
  std::vector<Stage> stages;
  void Ended(Stage stage) noexcept override { stages.push_back(stage); }
};

TEST(ControlCycle, TellsTheObserverItsStagesInOrder) {
  ControlCycle control(FlexibleRotorCycle());
  StillRig rig;
  Recorder recorder;
  (void)control.Step(rig.Next(), &recorder);
  EXPECT_EQ(recorder.stages, (std::vector{Stage::kCheck, Stage::kSupervise, Stage::kLaw}));
}

TEST(ControlCycle, AnswersTheFrameItWasGiven) {
  ControlCycle control(FlexibleRotorCycle());
  StillRig rig;
  CycleInputs in = rig.Next();
  in.frame.cycle = 4711;
  const CycleOutputs out = control.Step(in);
  EXPECT_EQ(out.current.cycle, 4711U);
  EXPECT_EQ(out.current.axes, 4U);
}

TEST(ControlCycle, CanBeMoved) {
  ControlCycle control(FlexibleRotorCycle());
  StillRig rig;
  ASSERT_EQ(Levitate(control, rig).mode, Mode::kLevitating);
  ControlCycle moved(std::move(control));
  EXPECT_EQ(moved.Step(rig.Next()).mode, Mode::kLevitating);
}

}  // namespace
}  // namespace levitas::cycle
