#include "controller/synchronous/synchronous_control.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "tests/support/allocation_guard.hpp"
#include "tests/unit/synchronous/bench_numbers.hpp"

namespace levitas::synchronous {
namespace {

RigNumbers Rig() {
  RigNumbers rig;
  rig.channels = {"de_x", "de_y"};
  rig.bearings = {"de"};
  rig.clearance_m = 200e-6;
  rig.sensor_range_m = 400e-6;
  return rig;
}

SynchronousConfig OneBlock(Target target = Target::kCurrent) {
  SynchronousConfig config;
  BlockConfig& block = config.blocks.emplace_back();
  block.target = target;
  block.from_rad_per_s = 200.0;
  block.to_rad_per_s = 400.0;
  block.hysteresis_rad_per_s = 10.0;
  block.time_constant_s = 0.1;
  block.largest_current_a = 0.5;
  InverseAtSpeed at;
  at.speed_rad_per_s = 300.0;
  at.inverse.real[0][0] = at.inverse.real[1][1] = target == Target::kCurrent ? 1.0 : 1e4;
  block.inverse.push_back(at);
  return config;
}

/// A rotor whose error answers at once to what the block gives, -1 times it, beside what turns.
struct Bench {
  explicit Bench(const SynchronousConfig& config) : control(config, Rig()) {}

  SynchronousControl control;
  Conditions seen;
  double angle_rad{};
  double speed_rad_per_s{300.0};
  double orbit_m{10e-6};
  AxisArray error_m{}, added_a{};
  std::function<void(Conditions&)> disturb;

  void Run(double time_s) {
    for (int n = 0; n < static_cast<int>(std::lround(time_s / kPeriodS)); ++n) Step();
  }
  void Step() {
    angle_rad += speed_rad_per_s * kPeriodS;
    angle_rad -= kTurn * std::floor(angle_rad / kTurn);
    seen.angle = {true, false, angle_rad, speed_rad_per_s, 1};
    seen.believed_speed_rad_per_s = speed_rad_per_s;
    seen.position_m[0] = orbit_m * std::cos(angle_rad);
    seen.position_m[1] = orbit_m * std::sin(angle_rad);
    seen.levitated = true;
    seen.saturated_axes = 0;
    if (disturb) disturb(seen);
    error_m = {};
    added_a = {};
    error_m[0] = -seen.position_m[0];
    error_m[1] = -seen.position_m[1];
    control.Step(seen, error_m, added_a);
  }
  [[nodiscard]] BlockState state() const { return control.status(0).state; }
  [[nodiscard]] Ending ending() const { return control.status(0).ending; }
  /// Steps until the block gives nothing any more; at most a second.
  [[nodiscard]] double FadeS() {
    int n = 0;
    while (state() != BlockState::kOff && state() != BlockState::kEnded && n < 10'000) {
      Step();
      ++n;
    }
    return n * kPeriodS;
  }
};

TEST(SynchronousControl, WithoutBlocksAndRunOutsNothingIsTouched) {
  Bench bench{SynchronousConfig{}};
  bench.Step();
  const AxisArray error = bench.error_m;
  AxisArray untouched{};
  untouched[0] = -bench.seen.position_m[0];
  untouched[1] = -bench.seen.position_m[1];
  EXPECT_EQ(std::memcmp(&error, &untouched, sizeof(error)), 0);
}

TEST(SynchronousControl, ABlockBeginsWithNothingAndTakesTheTurningErrorAway) {
  Bench bench(OneBlock());
  double largest_step = 0.0;
  double before = 0.0;
  bool began = false;
  for (int n = 0; n < 20'000; ++n) {
    bench.Step();
    const double taken = bench.error_m[0] + bench.seen.position_m[0];
    if (bench.state() == BlockState::kActing) {
      if (!began) {
        EXPECT_EQ(taken, 0.0) << "it begins without a step";
      }
      began = true;
      largest_step = std::max(largest_step, std::abs(taken - before));
    }
    before = taken;
  }
  EXPECT_TRUE(began);
  EXPECT_LT(std::hypot(bench.error_m[0], bench.error_m[1]), 1e-3 * bench.orbit_m);
  EXPECT_NEAR(bench.control.status(0).amplitude, bench.orbit_m, 1e-3 * bench.orbit_m);
  EXPECT_LT(largest_step, 1.1 * bench.orbit_m * bench.speed_rad_per_s * kPeriodS);
}

TEST(SynchronousControl, SpeedWindowHasHysteresis) {
  Bench bench(OneBlock());
  bench.speed_rad_per_s = 195.0;
  bench.Run(1.0);
  EXPECT_EQ(bench.state(), BlockState::kOff) << "within the hysteresis it does not begin";
  bench.speed_rad_per_s = 205.0;
  bench.Run(1.0);
  EXPECT_EQ(bench.state(), BlockState::kActing);
  bench.speed_rad_per_s = 195.0;
  bench.Run(1.0);
  EXPECT_EQ(bench.state(), BlockState::kActing) << "within the hysteresis it goes on";
  bench.speed_rad_per_s = 185.0;
  bench.Step();
  EXPECT_EQ(bench.state(), BlockState::kFading);
  EXPECT_EQ(bench.ending(), Ending::kSpeed);
  EXPECT_NEAR(bench.FadeS(), 0.1, 0.001) << "over its time constant";
  EXPECT_EQ(bench.state(), BlockState::kOff);
}

struct Trouble {
  const char* name;
  Ending ending;
  std::function<void(Conditions&)> disturb;
  bool again;
};

class EndsWithinATurn : public testing::TestWithParam<Trouble> {};

TEST_P(EndsWithinATurn, AndGivesNothingFromThere) {
  Bench bench(OneBlock());
  bench.Run(2.0);
  ASSERT_EQ(bench.state(), BlockState::kActing);
  bench.disturb = GetParam().disturb;
  const double turn_s = kTurn / bench.speed_rad_per_s;
  double waited_s = 0.0;
  while (bench.state() == BlockState::kActing && waited_s < 1.0) {
    bench.Step();
    waited_s += kPeriodS;
  }
  EXPECT_EQ(bench.ending(), GetParam().ending);
  const double fade_s = bench.FadeS();
  EXPECT_LE(fade_s, 0.5 * turn_s + 2.0 * kPeriodS);
  EXPECT_LE(waited_s + fade_s, std::max(1.05 * turn_s, 0.03 + turn_s));
  bench.Step();
  EXPECT_EQ(bench.error_m[0], -bench.seen.position_m[0]);
  bench.disturb = nullptr;
  bench.Run(2.0);
  EXPECT_EQ(bench.state(), GetParam().again ? BlockState::kActing : BlockState::kEnded);
  bench.speed_rad_per_s = 100.0;
  bench.Run(1.0);
  bench.speed_rad_per_s = 300.0;
  bench.Run(2.0);
  EXPECT_EQ(bench.state(), BlockState::kActing) << "the speed has left its window and come back";
}

INSTANTIATE_TEST_SUITE_P(
    OfEveryKind, EndsWithinATurn,
    testing::Values(
        Trouble{"lost", Ending::kAngleLost, [](Conditions& c) { c.angle.speed_unknown = true; },
                true},
        Trouble{"silent", Ending::kAngleLost, [](Conditions& c) { c.angle.fresh = false; }, true},
        Trouble{"stuck", Ending::kAngleJumped, [](Conditions& c) { c.angle.angle_rad = 1.0; },
                true},
        Trouble{
            "shifted", Ending::kAngleJumped,
            [](Conditions& c) { c.angle.angle_rad = std::fmod(c.angle.angle_rad + 2.0, kTurn); },
            true},
        Trouble{"saturated", Ending::kSaturated, [](Conditions& c) { c.saturated_axes = 1; },
                false},
        Trouble{"orbit", Ending::kOrbitGrew, [](Conditions& c) { c.position_m[0] = 80e-6; }, false},
        Trouble{"released", Ending::kNotLevitated, [](Conditions& c) { c.levitated = false; },
                true}),
    [](const auto& trial) { return trial.param.name; });

TEST(SynchronousControl, ASlowFadeIsWatchedToItsEnd) {
  SynchronousConfig config = OneBlock();
  config.blocks.front().time_constant_s = 0.5;
  for (const bool released : {true, false}) {
    Bench bench(config);
    bench.speed_rad_per_s = 205.0;
    bench.Run(3.0);
    bench.speed_rad_per_s = 188.0;
    bench.Run(0.01);
    ASSERT_EQ(bench.ending(), Ending::kSpeed);
    bench.disturb = [&](Conditions& c) {
      if (released) {
        c.levitated = false;
      } else {
        c.angle.angle_rad = std::fmod(c.angle.angle_rad + 2.0, kTurn);
      }
    };
    bench.Step();
    EXPECT_EQ(bench.ending(), released ? Ending::kNotLevitated : Ending::kAngleJumped);
    EXPECT_LE(bench.FadeS(), 0.5 * kTurn / bench.speed_rad_per_s + 2.0 * kPeriodS);
  }
}

TEST(SynchronousControl, GivesWayBeforeTheSupervisorTripsHoweverLargeTheOrbitWasAtFirst) {
  SynchronousConfig config = OneBlock();
  config.least_orbit_fraction = 0.9;
  Bench bench(config);
  bench.orbit_m = 70e-6;  // of 200 um; twice that lies beyond the trip at 100 um
  bench.Run(2.0);
  ASSERT_EQ(bench.state(), BlockState::kActing);
  bench.orbit_m = 90e-6;
  bench.Run(0.1);
  EXPECT_EQ(bench.ending(), Ending::kOrbitGrew);
}

TEST(SynchronousControl, AClippedCurrentEndsItAlthoughItLeavesTheLimitTwiceAPeriod) {
  for (const int share_of_ten : {1, 4}) {
    Bench bench(OneBlock());
    bench.Run(2.0);
    int n = 0;
    bench.disturb = [&](Conditions& c) { c.saturated_axes = n++ % 10 < share_of_ten ? 2 : 0; };
    bench.Run(1.0);
    EXPECT_EQ(bench.ending(), share_of_ten > 2 ? Ending::kSaturated : Ending::kNone);
  }
}

TEST(SynchronousControl, AnotherTrialWaitsForACalmOrbitAndIsCountedUntilTheSpeedHasLeft) {
  SynchronousConfig config = OneBlock();
  config.blocks.front().adaptive = true;
  config.blocks.front().least_change_m = 1e-9;
  Bench bench(config);
  bench.Run(2.0);
  ASSERT_GT(bench.control.influence(0).learned(), 0U);
  for (int trial = 0; trial <= SynchronousControl::kRetries; ++trial) {
    ASSERT_EQ(bench.state(), BlockState::kActing) << trial;
    bench.orbit_m = 80e-6;
    bench.Run(0.2);
    EXPECT_EQ(bench.state(),
              trial < SynchronousControl::kRetries ? BlockState::kOff : BlockState::kEnded)
        << "while the orbit is large nothing begins";
    bench.orbit_m = 10e-6;
    bench.Run(0.5);
  }
  EXPECT_EQ(bench.state(), BlockState::kEnded);
  bench.speed_rad_per_s = 100.0;
  bench.Run(1.0);
  bench.speed_rad_per_s = 300.0;
  bench.Run(2.0);
  EXPECT_EQ(bench.state(), BlockState::kActing);
}

TEST(SynchronousControl, ABlockThatNeedsMoreCurrentThanAllowedEnds) {
  SynchronousConfig config = OneBlock(Target::kVibration);
  Bench bench(config);
  bench.Run(0.3);
  ASSERT_EQ(bench.state(), BlockState::kActing);
  EXPECT_NE(bench.added_a[0], 0.0);
  // Nothing answers: the amplitude grows until it is more than it may be.
  bench.Run(5.0);
  EXPECT_EQ(bench.state(), BlockState::kEnded);
  EXPECT_EQ(bench.ending(), Ending::kCurrentTooLarge);
  EXPECT_EQ(bench.added_a[0], 0.0);
}

TEST(SynchronousControl, NegativeSpeedsHaveNoBlocks) {
  Bench bench(OneBlock());
  bench.speed_rad_per_s = -300.0;
  bench.disturb = [](Conditions& c) { c.believed_speed_rad_per_s = 300.0; };
  bench.Run(2.0);
  EXPECT_EQ(bench.state(), BlockState::kOff);
}

TEST(SynchronousControl, RunOutIsTakenOffWithoutAStep) {
  SynchronousConfig config;
  RunOut& run_out = config.run_outs.emplace_back();
  run_out.real_m[0] = 10e-6;
  run_out.imaginary_m[1] = -10e-6;  // 10 um cos(angle), 10 um sin(angle)
  Bench bench(config);
  double before = 0.0;
  double largest_step = 0.0;
  for (int n = 0; n < 20'000; ++n) {
    bench.Step();
    const double taken = bench.error_m[0] + bench.seen.position_m[0];
    largest_step = std::max(largest_step, std::abs(taken - before));
    before = taken;
  }
  EXPECT_NEAR(bench.error_m[0], 0.0, 1e-9) << "all that was read was run-out";
  EXPECT_NEAR(bench.error_m[1], 0.0, 1e-9);
  EXPECT_LT(largest_step, 1.2 * 10e-6 * bench.speed_rad_per_s * kPeriodS);
}

TEST(SynchronousControl, AllocatesNothing) {
  SynchronousConfig config = OneBlock();
  config.blocks.front().adaptive = true;
  config.blocks.front().least_change_m = 1e-9;
  Bench bench(config);
  const test::AllocationGuard guard;
  bench.Run(2.0);
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(bench.control.influence(0).learned(), 0U) << "a matrix was inverted";
}

TEST(SynchronousControl, RefusesMoreBlocksThanItHasRoomFor) {
  SynchronousConfig config = OneBlock();
  config.blocks.resize(kMaxBlocks + 1, config.blocks.front());
  EXPECT_THROW((SynchronousControl{config, Rig()}), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::synchronous
