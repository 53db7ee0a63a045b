#include "controller/scenario/scenario_player.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/support/allocation_guard.hpp"

namespace levitas::scenario {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kStandstill_rad_per_s = 0.5;

Step Lift(double hold_s = 0.0) {
  Step step;
  step.command = OperatorCommand::kLift;
  step.wait = Wait::kMode;
  step.wait_mode = Mode::kLevitating;
  step.timeout_s = 0.010;
  step.hold_s = hold_s;
  return step;
}

Step Spin(double speed_rad_per_s, Wait wait) {
  Step step;
  step.command = OperatorCommand::kSpin;
  step.speed_rad_per_s = speed_rad_per_s;
  step.acceleration_rad_per_s2 = 50.0;
  step.wait = wait;
  step.timeout_s = 0.010;
  return step;
}

Step Nothing(double hold_s) {
  Step step;
  step.hold_s = hold_s;
  return step;
}

ScenarioPlayer Player(std::vector<Step> steps) {
  return ScenarioPlayer({"test", std::move(steps), {}}, kPeriod_s, kStandstill_rad_per_s);
}

TEST(ScenarioPlayer, GivesACommandInExactlyOneCycle) {
  ScenarioPlayer player = Player({Lift()});
  EXPECT_EQ(player.Next(Mode::kOff, 0.0, Fault::kNone).command, OperatorCommand::kLift);
  EXPECT_EQ(player.Next(Mode::kSelfTest, 0.0, Fault::kNone).command, OperatorCommand::kNone);
  EXPECT_EQ(player.Next(Mode::kLift, 0.0, Fault::kNone).command, OperatorCommand::kNone);
  EXPECT_EQ(player.outcome(), Outcome::kPlaying);
}

TEST(ScenarioPlayer, HoldsForTheCyclesOfItsTimeAndThenGoesOn) {
  ScenarioPlayer player = Player({Lift(0.003), Spin(100.0, Wait::kSpeedReached)});
  (void)player.Next(Mode::kOff, 0.0, Fault::kNone);
  for (int cycle = 0; cycle < 3; ++cycle) {  // 3 ms at 1 ms
    EXPECT_EQ(player.Next(Mode::kLevitating, 0.0, Fault::kNone).command, OperatorCommand::kNone);
    EXPECT_EQ(player.step(), 0U);
  }
  const PlayerOutput output = player.Next(Mode::kLevitating, 0.0, Fault::kNone);
  EXPECT_EQ(output.command, OperatorCommand::kSpin);
  EXPECT_EQ(output.speed_rad_per_s, 100.0);
  EXPECT_EQ(output.acceleration_rad_per_s2, 50.0);
  EXPECT_EQ(player.step(), 1U);
}

TEST(ScenarioPlayer, FinishesAfterTheLastHold) {
  ScenarioPlayer player = Player({Nothing(0.002)});
  (void)player.Next(Mode::kOff, 0.0, Fault::kNone);
  (void)player.Next(Mode::kOff, 0.0, Fault::kNone);
  (void)player.Next(Mode::kOff, 0.0, Fault::kNone);
  EXPECT_FALSE(player.finished());
  (void)player.Next(Mode::kOff, 0.0, Fault::kNone);
  EXPECT_TRUE(player.finished());
  EXPECT_FALSE(player.failed());
  EXPECT_EQ(player.Text(), "");
}

TEST(ScenarioPlayer, WithoutStepsIsFinishedAtOnce) { EXPECT_TRUE(Player({}).finished()); }

TEST(ScenarioPlayer, ReachesASpeedWithinHalfAPercent) {
  for (const auto& [speed, reached] : {std::pair{99.4, false}, std::pair{99.6, true}}) {
    ScenarioPlayer player = Player({Spin(100.0, Wait::kSpeedReached)});
    (void)player.Next(Mode::kLevitating, 0.0, Fault::kNone);
    (void)player.Next(Mode::kSpinning, speed, Fault::kNone);
    EXPECT_EQ(player.finished(), reached) << speed;
  }
}

TEST(ScenarioPlayer, StandstillNeedsASpeedBelowTheControllersThreshold) {
  for (const auto& [speed, reached] :
       {std::pair{0.5, false}, std::pair{-0.6, false}, std::pair{0.49, true}}) {
    ScenarioPlayer player = Player({Spin(0.0, Wait::kStandstill)});
    (void)player.Next(Mode::kSpinning, 100.0, Fault::kNone);
    (void)player.Next(Mode::kSpinning, speed, Fault::kNone);
    EXPECT_EQ(player.finished(), reached) << speed;
  }
}

TEST(ScenarioPlayer, NeverReachesASpeedThatIsNotANumber) {
  ScenarioPlayer player = Player({Spin(0.0, Wait::kStandstill)});
  for (int cycle = 0; cycle < 20; ++cycle) {
    (void)player.Next(Mode::kSpinning, std::numeric_limits<double>::quiet_NaN(), Fault::kNone);
  }
  EXPECT_EQ(player.outcome(), Outcome::kTimedOut);
}

TEST(ScenarioPlayer, FailsOneCycleAfterTheTimeOutAndSaysWhere) {
  ScenarioPlayer player = Player({Nothing(0.0), Lift()});
  (void)player.Next(Mode::kOff, 0.0, Fault::kNone);
  EXPECT_EQ(player.Next(Mode::kOff, 0.0, Fault::kNone).command, OperatorCommand::kLift);
  for (int cycle = 0; cycle < 10; ++cycle) {  // 10 ms at 1 ms are still allowed
    (void)player.Next(Mode::kLift, 0.0, Fault::kNone);
    ASSERT_FALSE(player.failed()) << cycle;
  }
  (void)player.Next(Mode::kLift, 0.0, Fault::kNone);
  EXPECT_EQ(player.outcome(), Outcome::kTimedOut);
  EXPECT_EQ(
      player.Text(),
      "scenario test, step 2 of 2 (lift): mode levitating was not reached within 0.01 s; mode "
      "is lift");
}

TEST(ScenarioPlayer, SaysWhichSpeedWasMissed) {
  ScenarioPlayer player = Player({Spin(314.159265358979, Wait::kSpeedReached)});
  for (int cycle = 0; cycle < 20; ++cycle) {
    (void)player.Next(Mode::kSpinning, 209.43951023932, Fault::kNone);
  }
  EXPECT_EQ(player.Text(),
            "scenario test, step 1 of 1 (spin): 3000 rpm was not reached within 0.01 s; speed is "
            "2000 rpm");
}

TEST(ScenarioPlayer, ATripEndsItAsTripped) {
  ScenarioPlayer player = Player({Lift(1.0), Spin(100.0, Wait::kSpeedReached)});
  (void)player.Next(Mode::kOff, 0.0, Fault::kNone);
  (void)player.Next(Mode::kLevitating, 0.0, Fault::kNone);
  (void)player.Next(Mode::kTripped, 0.0, Fault::kOrbitExceeded);
  EXPECT_EQ(player.outcome(), Outcome::kTripped);
  EXPECT_EQ(player.Text(),
            "scenario test, step 1 of 2 (lift): the controller tripped: orbit_exceeded");
  for (int cycle = 0; cycle < 2000; ++cycle) {
    const PlayerOutput output = player.Next(Mode::kOff, 0.0, Fault::kNone);
    ASSERT_EQ(output.command, OperatorCommand::kNone);
  }
  EXPECT_EQ(player.outcome(), Outcome::kTripped);
}

TEST(ScenarioPlayer, ARefusedCommandEndsItAsRefused) {
  ScenarioPlayer player = Player({Spin(100.0, Wait::kSpeedReached)});
  (void)player.Next(Mode::kOff, 0.0, Fault::kNone);
  (void)player.Next(Mode::kOff, 0.0, Fault::kNone, true);
  EXPECT_EQ(player.outcome(), Outcome::kRefused);
  EXPECT_EQ(player.Text(),
            "scenario test, step 1 of 1 (spin): the controller refused the command in mode off");
}

TEST(ScenarioPlayer, ARefusalOfSomebodyElsesCommandLaterIsNotItsOwn) {
  ScenarioPlayer player = Player({Lift()});
  (void)player.Next(Mode::kOff, 0.0, Fault::kNone);
  (void)player.Next(Mode::kSelfTest, 0.0, Fault::kNone, false);
  (void)player.Next(Mode::kSelfTest, 0.0, Fault::kNone, true);
  EXPECT_EQ(player.outcome(), Outcome::kPlaying);
}

TEST(ScenarioPlayer, ATripItAskedForIsNoFailureUntilItHasBeenReset) {
  Step stop;
  stop.command = OperatorCommand::kEmergencyStop;
  stop.wait = Wait::kMode;
  stop.wait_mode = Mode::kTripped;
  stop.timeout_s = 0.010;
  Step reset;
  reset.command = OperatorCommand::kReset;
  reset.wait = Wait::kMode;
  reset.wait_mode = Mode::kOff;
  reset.timeout_s = 0.010;
  ScenarioPlayer player = Player({stop, reset, Nothing(1.0)});
  (void)player.Next(Mode::kLevitating, 0.0, Fault::kNone);
  const PlayerOutput second = player.Next(Mode::kTripped, 0.0, Fault::kEmergencyStop);
  EXPECT_EQ(second.command, OperatorCommand::kReset);
  (void)player.Next(Mode::kOff, 0.0, Fault::kNone);
  EXPECT_EQ(player.outcome(), Outcome::kPlaying);
  (void)player.Next(Mode::kTripped, 0.0, Fault::kSensorFrozen);
  EXPECT_EQ(player.outcome(), Outcome::kTripped);  // a trip after the reset is nobody's wish
}

TEST(ScenarioPlayer, ExcitesDuringTheHoldAndOnlyThen) {
  Step step = Lift(0.127);
  step.excitation = {{"de_y", 1, 0.05, 7, 1, 0.0}};
  ScenarioPlayer player = Player({step, Nothing(0.01)});
  EXPECT_EQ(player.Next(Mode::kOff, 0.0, Fault::kNone).excitation_a, AxisArray{});
  EXPECT_EQ(player.Next(Mode::kLift, 0.0, Fault::kNone).excitation_a, AxisArray{});
  double sum_a = 0.0;
  for (int cycle = 0; cycle < 127; ++cycle) {
    const PlayerOutput output = player.Next(Mode::kLevitating, 0.0, Fault::kNone);
    EXPECT_EQ(std::abs(output.excitation_a[1]), 0.05);
    EXPECT_EQ(output.excitation_a[0], 0.0);
    sum_a += output.excitation_a[1];
  }
  EXPECT_NEAR(sum_a, 0.05, 1e-12);  // one period of order 7 holds one more + than -; 127 roundings
  EXPECT_EQ(player.Next(Mode::kLevitating, 0.0, Fault::kNone).excitation_a, AxisArray{});
}

TEST(ScenarioPlayer, HoldsEachBitForTheDivisorsCycles) {
  Step step = Nothing(0.4);
  step.excitation = {{"de_x", 0, 1.0, 9, 4, 0.0}};
  ScenarioPlayer player = Player({step});
  (void)player.Next(Mode::kLevitating, 0.0, Fault::kNone);
  Prbs expected(9);
  for (int bit = 0; bit < 100; ++bit) {
    const double level_a = expected.Next() ? 1.0 : -1.0;
    for (int cycle = 0; cycle < 4; ++cycle) {
      ASSERT_EQ(player.Next(Mode::kLevitating, 0.0, Fault::kNone).excitation_a[0], level_a);
    }
  }
}

TEST(ScenarioPlayer, AddsTwoExcitationsOfOneAxis) {
  Step step = Nothing(0.01);
  step.excitation = {{"de_x", 0, 0.25, 7, 1, 0.0}, {"de_x", 0, 0.5, 7, 1, 0.0}};
  ScenarioPlayer player = Player({step});
  (void)player.Next(Mode::kLevitating, 0.0, Fault::kNone);
  EXPECT_EQ(std::abs(player.Next(Mode::kLevitating, 0.0, Fault::kNone).excitation_a[0]), 0.75);
}

TEST(ScenarioPlayer, RefusesAPeriodThatIsNotPositiveAndAnAxisThatIsNotThere) {
  EXPECT_THROW(ScenarioPlayer({"test", {Lift()}, {}}, 0.0, 0.5), std::invalid_argument);
  EXPECT_THROW(
      ScenarioPlayer({"test", {Lift()}, {}}, std::numeric_limits<double>::quiet_NaN(), 0.5),
      std::invalid_argument);
  Step step = Nothing(1.0);
  step.excitation = {{"none", kMaxAxes, 0.1, 7, 1, 0.0}};
  EXPECT_THROW(Player({step}), std::invalid_argument);
}

TEST(ScenarioPlayer, AllocatesNothingWhilePlaying) {
  Step step = Nothing(5.0);
  step.excitation = {{"de_x", 0, 0.1, 15, 3, 0.25}};
  ScenarioPlayer player = Player({Lift(1.0), step, Lift()});
  const test::AllocationGuard guard;
  for (int cycle = 0; cycle < 10'000; ++cycle) {
    (void)player.Next(cycle < 8 ? Mode::kLift : Mode::kLevitating, 0.0, Fault::kNone);
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_TRUE(player.finished());
}

}  // namespace
}  // namespace levitas::scenario
