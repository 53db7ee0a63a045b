#include "controller/loop/command_arbiter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"

namespace levitas::loop {
namespace {

constexpr ArbiterOptions kOptions{
    .period_s = 1e-4, .stop_acceleration_rad_per_s2 = 50.0, .standstill_rad_per_s = 1.0};

constexpr std::int64_t kReceivedNs = 123'456'789;

OperatorView View(std::uint64_t cycle, Mode mode, double speed_rad_per_s = 0.0) {
  return {.cycle = cycle,
          .mode = mode,
          .amplifiers_enabled = mode != Mode::kOff,
          .standing = std::abs(speed_rad_per_s) < kOptions.standstill_rad_per_s,
          .speed_rad_per_s = speed_rad_per_s};
}

TEST(CommandArbiter, WithoutScenarioOrCommandAsksForNothingAndDoesNotEnd) {
  CommandArbiter desk(kOptions, nullptr, {});
  for (std::uint64_t cycle = 0; cycle < 1000; ++cycle) {
    EXPECT_EQ(desk.Next(View(cycle, Mode::kOff)).command, OperatorCommand::kNone);
  }
  EXPECT_FALSE(desk.Done());
}

TEST(CommandArbiter, PassesARemoteCommandOnOnce) {
  SpscRing<RemoteCommand> ring(4);
  CommandArbiter desk(kOptions, nullptr, {&ring});
  ring.Post({OperatorCommand::kSpin, 100.0, 10.0});
  const auto input = desk.Next(View(0, Mode::kLevitating));
  EXPECT_EQ(input.command, OperatorCommand::kSpin);
  EXPECT_EQ(input.speed_rad_per_s, 100.0);
  EXPECT_EQ(input.acceleration_rad_per_s2, 10.0);
  EXPECT_EQ(desk.Next(View(1, Mode::kLevitating)).command, OperatorCommand::kNone);
}

/// A test signal of 20 cycles, then a landing: the cycles of a scenario that has both.
scenario::ScenarioConfig SignalThenLand() {
  scenario::Excitation bits;
  bits.order = 5;
  bits.amplitude_a = 0.25;
  scenario::Step signal;
  signal.hold_s = 20 * kOptions.period_s;
  signal.excitation.push_back(bits);
  scenario::Step land;
  land.command = OperatorCommand::kLand;
  land.hold_s = 1.0;
  return {.name = "marked", .steps = {signal, land}, .rig_events = {}};
}

TEST(CommandArbiter, AMarkTakesNothingFromTheScenarioAndWaitsForACycleWithoutCommand) {
  std::optional<std::uint64_t> landed;
  constexpr std::uint64_t kCycles = 60;
  std::vector<cycle::OperatorInput> unmarked;
  {
    scenario::ScenarioPlayer player(SignalThenLand(), kOptions.period_s, 1.0);
    CommandArbiter desk(kOptions, &player, {});
    for (std::uint64_t cycle = 0; cycle < kCycles; ++cycle) {
      unmarked.push_back(desk.Next(View(cycle, Mode::kLevitating)));
      if (unmarked.back().command == OperatorCommand::kLand) landed = cycle;
    }
  }
  ASSERT_TRUE(landed);
  for (const std::uint64_t asked : {std::uint64_t{5}, *landed}) {
    SpscRing<RemoteCommand> ring(4);
    SpscRing<GivenCommand> given(4);
    scenario::ScenarioPlayer player(SignalThenLand(), kOptions.period_s, 1.0);
    CommandArbiter desk(kOptions, &player, {&ring, nullptr, &given});
    const std::uint64_t marked = asked == *landed ? asked + 1 : asked;
    for (std::uint64_t cycle = 0; cycle < kCycles; ++cycle) {
      if (cycle == asked) ring.Post({.command = OperatorCommand::kMark, .origin = {3, 7}});
      const auto input = desk.Next(View(cycle, Mode::kLevitating));
      EXPECT_EQ(input.excitation_a, unmarked[cycle].excitation_a) << cycle;
      EXPECT_EQ(input.command, cycle == marked ? OperatorCommand::kMark : unmarked[cycle].command)
          << cycle;
    }
    GivenCommand answered;
    ASSERT_TRUE(given.Take(answered));
    EXPECT_EQ(answered.cycle, marked);
    EXPECT_EQ(answered.origin.sequence, 7);
  }
}

TEST(CommandArbiter, EndsAtOnceWhenStoppedWithTheRotorDown) {
  CommandArbiter desk(kOptions, nullptr, {});
  desk.RequestStop();
  EXPECT_EQ(desk.Next(View(0, Mode::kOff)).command, OperatorCommand::kNone);
  EXPECT_TRUE(desk.Done());
}

TEST(CommandArbiter, StopsASpinningRotorBrakesItThenLandsItThenEnds) {
  CommandArbiter desk(kOptions, nullptr, {});
  desk.RequestStop();
  const auto brake = desk.Next(View(0, Mode::kSpinning, 300.0));
  EXPECT_EQ(brake.command, OperatorCommand::kSpin);
  EXPECT_EQ(brake.speed_rad_per_s, 0.0);
  EXPECT_EQ(brake.acceleration_rad_per_s2, 50.0);
  for (std::uint64_t cycle = 1; cycle < 50'000; ++cycle) {  // braking: no further request
    EXPECT_EQ(desk.Next(View(cycle, Mode::kSpinning, 200.0)).command, OperatorCommand::kNone);
  }
  EXPECT_EQ(desk.Next(View(50'000, Mode::kLevitating)).command, OperatorCommand::kLand);
  EXPECT_EQ(desk.Next(View(50'001, Mode::kLanding)).command, OperatorCommand::kNone);
  EXPECT_FALSE(desk.Done());
  (void)desk.Next(View(60'000, Mode::kOff));
  EXPECT_TRUE(desk.Done());
}

TEST(CommandArbiter, AsksAgainWhenTheRequestOfTheEndWasRefused) {
  CommandArbiter desk(kOptions, nullptr, {});
  desk.RequestStop();
  int asked = 0;
  for (std::uint64_t cycle = 0; cycle <= 3'000; ++cycle) {
    if (desk.Next(View(cycle, Mode::kLevitating)).command == OperatorCommand::kLand) ++asked;
  }
  EXPECT_EQ(asked, 4);  // cycles 0, 1000, 2000 and 3000: each 0.1 s
}

TEST(CommandArbiter, MakesAnEndThatIsNotReachedAnEmergencyStop) {
  CommandArbiter desk(kOptions, nullptr, {});
  desk.RequestStop();
  (void)desk.Next(View(0, Mode::kLevitating));
  EXPECT_EQ(desk.Next(View(100'000, Mode::kLevitating)).command, OperatorCommand::kLand);
  EXPECT_FALSE(desk.news().overdue);
  // Nothing turns: no time for running down, none for a ramp, and the margin of 10 s.
  EXPECT_EQ(desk.Next(View(101'001, Mode::kLevitating)).command, OperatorCommand::kEmergencyStop);
  EXPECT_TRUE(desk.news().overdue);
}

TEST(CommandArbiter, GivesARequestedEmergencyStopOnceAndBeforeTheEnd) {
  CommandArbiter desk(kOptions, nullptr, {});
  desk.RequestEmergencyStop();
  desk.RequestStop();
  EXPECT_EQ(desk.Next(View(0, Mode::kSpinning, 300.0)).command, OperatorCommand::kEmergencyStop);
  for (std::uint64_t cycle = 1; cycle < 100; ++cycle) {  // the trip brakes: nothing more to ask
    EXPECT_EQ(desk.Next(View(cycle, Mode::kTripped, 300.0)).command, OperatorCommand::kNone);
  }
}

TEST(CommandArbiter, BeginsTheEndWhenTheDurationIsOver) {
  ArbiterOptions options = kOptions;
  options.duration_s = 1.0;
  CommandArbiter desk(options, nullptr, {});
  EXPECT_EQ(desk.Next(View(0, Mode::kLevitating)).command, OperatorCommand::kNone);
  EXPECT_EQ(desk.Next(View(9'999, Mode::kLevitating)).command, OperatorCommand::kNone);
  EXPECT_EQ(desk.Next(View(10'000, Mode::kLevitating)).command, OperatorCommand::kLand);
}

TEST(CommandArbiter, WhileEndingTakesNoRemoteCommandButTheEmergencyStop) {
  SpscRing<RemoteCommand> ring(4);
  StopLatch stops;
  CommandArbiter desk(kOptions, nullptr, {&ring, &stops});
  desk.RequestStop();
  (void)desk.Next(View(0, Mode::kSpinning, 300.0));
  ring.Post({OperatorCommand::kSpin, 500.0, 10.0});
  EXPECT_EQ(desk.Next(View(1, Mode::kSpinning, 300.0)).command, OperatorCommand::kNone);
  stops.Ask(kReceivedNs, {});
  EXPECT_EQ(desk.Next(View(2, Mode::kSpinning, 300.0)).command, OperatorCommand::kEmergencyStop);
}

TEST(CommandArbiter, WithoutAScenarioWaitsForTheResetOfATrip) {
  CommandArbiter desk(kOptions, nullptr, {});
  OperatorView tripped = View(0, Mode::kTripped);
  tripped.fault = Fault::kRigRestarted;
  tripped.amplifiers_enabled = false;
  for (; tripped.cycle < 20'000; ++tripped.cycle) (void)desk.Next(tripped);
  EXPECT_FALSE(desk.Done());
}

TEST(CommandArbiter, TakesOneRemoteCommandPerCycleInTheOrderTheyCame) {
  SpscRing<RemoteCommand> ring(4);
  CommandArbiter desk(kOptions, nullptr, {&ring});
  const OperatorCommand sent[] = {OperatorCommand::kSpin, OperatorCommand::kCoastDown,
                                  OperatorCommand::kLand, OperatorCommand::kLift};
  for (const auto command : sent) ASSERT_TRUE(ring.Post({command, 1.0, 1.0}));
  for (std::uint64_t cycle = 0; cycle < 4; ++cycle) {
    EXPECT_EQ(desk.Next(View(cycle, Mode::kLevitating)).command, sent[cycle]);
  }
  EXPECT_EQ(desk.Next(View(4, Mode::kLevitating)).command, OperatorCommand::kNone);
}

TEST(CommandArbiter, ServesWhatAFullRingHoldsAndTheRingCountsWhatItRefused) {
  SpscRing<RemoteCommand> ring(2);
  CommandArbiter desk(kOptions, nullptr, {&ring});
  for (int i = 0; i < 5; ++i) ring.Post({OperatorCommand::kSpin, 10.0 * i, 1.0});
  EXPECT_EQ(ring.lost(), 3U);
  EXPECT_EQ(desk.Next(View(0, Mode::kSpinning)).speed_rad_per_s, 0.0);
  EXPECT_EQ(desk.Next(View(1, Mode::kSpinning)).speed_rad_per_s, 10.0);
  EXPECT_EQ(desk.Next(View(2, Mode::kSpinning)).command, OperatorCommand::kNone);
}

// Two desks that see the same give the same: no clock, no history but the view.
TEST(CommandArbiter, GivesTheSameInputsForTheSameViews) {
  ArbiterOptions options = kOptions;
  options.duration_s = 0.2;
  CommandArbiter one(options, nullptr, {});
  CommandArbiter other(options, nullptr, {});
  Random random(20261121);
  for (std::uint64_t cycle = 0; cycle < 10'000; ++cycle) {
    const auto mode = static_cast<Mode>(random.Bits() % kModeCount);
    const OperatorView view = View(cycle, mode, 300.0 * random.Uniform());
    const auto input = one.Next(view);
    const auto again = other.Next(view);
    ASSERT_EQ(input.command, again.command) << cycle;
    ASSERT_EQ(input.acceleration_rad_per_s2, again.acceleration_rad_per_s2) << cycle;
    ASSERT_EQ(one.Done(), other.Done()) << cycle;
    // Before the duration is over a desk without a scenario has no wishes of its own.
    if (cycle < 2'000) {
      ASSERT_EQ(input.command, OperatorCommand::kNone) << cycle;
    }
  }
}

}  // namespace
}  // namespace levitas::loop
