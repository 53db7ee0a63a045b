// How a run ends whose rotor still turns: each kind of end, with a brake and without.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "controller/loop/command_arbiter.hpp"

namespace levitas::loop {
namespace {

constexpr double kPeriodS = 1e-3;
constexpr double kRate = 50.0;        // rad/s2
constexpr double kSpeed = 300.0;      // rad/s: 6 s to run down
constexpr double kStandstill = 1.0;   // rad/s
constexpr double kTripWindowS = 0.5;  // the least time of record after a trip

constexpr ArbiterOptions kDesk{.period_s = kPeriodS,
                               .stop_acceleration_rad_per_s2 = kRate,
                               .standstill_rad_per_s = kStandstill,
                               .landing_ramp_s = 0.5,
                               .trip_window_s = kTripWindowS};

scenario::ScenarioConfig Lift() {
  scenario::ScenarioConfig config;
  config.name = "lift";
  scenario::Step lift;
  lift.command = OperatorCommand::kLift;
  lift.wait = scenario::Wait::kMode;
  lift.wait_mode = Mode::kLevitating;
  lift.timeout_s = 5.0;
  config.steps.push_back(lift);
  return config;
}

/// A rotor that was let go at speed, and the desk that ends the run.
class LetGo {
 public:
  explicit LetGo(CommandArbiter& desk, Mode mode = Mode::kTripped) : desk_(desk), mode_(mode) {}

  /// Time until the desk is done; nothing when it is not within `limit_s`.
  std::optional<double> Done(double true_rate, double limit_s) {
    const std::uint64_t first = cycle_;
    while (static_cast<double>(cycle_ - first) * kPeriodS < limit_s) {
      speed_ = std::max(0.0, speed_ - true_rate * kPeriodS);
      (void)desk_.Next({.cycle = ++cycle_,
                        .mode = mode_,
                        .fault = mode_ == Mode::kTripped ? Fault::kOrbitExceeded : Fault::kNone,
                        .amplifiers_enabled = false,
                        .standing = speed_ < kStandstill,
                        .speed_rad_per_s = speed_});
      if (desk_.Done()) return static_cast<double>(cycle_ - first) * kPeriodS;
    }
    return std::nullopt;
  }
  [[nodiscard]] double speed() const { return speed_; }

 private:
  CommandArbiter& desk_;
  Mode mode_;
  double speed_{kSpeed};
  std::uint64_t cycle_{0};
};

TEST(EndOfRun, AfterAReleaseAtSpeedUnderAScenarioTheDeskStaysUntilTheRotorStands) {
  scenario::ScenarioPlayer player(Lift(), kPeriodS, kStandstill);
  CommandArbiter desk(kDesk, &player, {});
  (void)desk.Next({.cycle = 0, .mode = Mode::kOff, .standing = true});
  LetGo rotor(desk);
  const auto done_s = rotor.Done(kRate, 20.0);
  ASSERT_TRUE(done_s.has_value());
  EXPECT_LT(rotor.speed(), kStandstill);
  EXPECT_GT(*done_s, kSpeed / kRate - 0.1);
  EXPECT_FALSE(desk.news().brake_fails);
  EXPECT_TRUE(desk.standing());
}

TEST(EndOfRun, AfterAReleaseAtSpeedADurationThatIsOverWaitsUntilTheRotorStands) {
  ArbiterOptions options = kDesk;
  options.duration_s = 0.1;
  CommandArbiter desk(options, nullptr, {});
  LetGo rotor(desk);
  ASSERT_TRUE(rotor.Done(kRate, 20.0).has_value());
  EXPECT_LT(rotor.speed(), kStandstill);
}

TEST(EndOfRun, AfterAReleaseAtSpeedARequestToStopWaitsUntilTheRotorStands) {
  for (const Mode mode : {Mode::kTripped, Mode::kOff}) {
    CommandArbiter desk(kDesk, nullptr, {});
    desk.RequestStop();
    LetGo rotor(desk, mode);
    ASSERT_TRUE(rotor.Done(kRate, 20.0).has_value());
    EXPECT_LT(rotor.speed(), kStandstill);
  }
}

TEST(EndOfRun, WithABrakeThatDoesNothingTheDeskSaysSoAndEndsWithTheRotorTurning) {
  CommandArbiter desk(kDesk, nullptr, {});
  desk.RequestStop();
  LetGo rotor(desk);
  const auto done_s = rotor.Done(0.0, 20.0);
  ASSERT_TRUE(done_s.has_value());
  EXPECT_GE(*done_s, 2.0 * RunDown::kBrakeS);
  EXPECT_TRUE(desk.news().brake_fails);
  EXPECT_EQ(desk.news().speed_rad_per_s, kSpeed);
  EXPECT_FALSE(desk.standing());
}

TEST(EndOfRun, ARotorThatStandsIsStillRecordedForTheWindowOfTheTrip) {
  CommandArbiter desk(kDesk, nullptr, {});
  desk.RequestStop();
  LetGo rotor(desk);
  ASSERT_FALSE(rotor.Done(1e9, kTripWindowS - 0.01).has_value());
  EXPECT_TRUE(rotor.Done(1e9, 0.02).has_value());
}

// Turning and held, with a brake that does nothing: letting go would be the harm.
TEST(EndOfRun, ALevitatedRotorThatDoesNotSlowDownIsStoppedSaidAndNeverLetGo) {
  CommandArbiter desk(kDesk, nullptr, {});
  desk.RequestStop();
  int stops = 0;
  OperatorView view{
      .cycle = 0, .mode = Mode::kSpinning, .amplifiers_enabled = true, .speed_rad_per_s = kSpeed};
  for (; view.cycle < 200'000; ++view.cycle) {
    if (desk.Next(view).command == OperatorCommand::kEmergencyStop) {
      ++stops;
      // Not before the time of the files: 6 s, a ramp of 0.5 s, 10 s.
      EXPECT_GT(view.cycle, 16'500U);
      view.mode = Mode::kTripped;
      view.fault = Fault::kEmergencyStop;
    }
    ASSERT_FALSE(desk.Done()) << view.cycle;
  }
  EXPECT_EQ(stops, 1);
  EXPECT_TRUE(desk.news().overdue);
}

// Nothing the desk asks for lifts a rotor that was let go (EndTable.NothingThatAnEndAsksFor...).
// Whatever else has done so, the rotor is braked and landed like any other.
TEST(EndOfRun, ARotorThatIsHeldAgainAfterItsReleaseIsBrakedAgain) {
  CommandArbiter desk(kDesk, nullptr, {});
  desk.RequestStop();
  OperatorView view{
      .cycle = 0, .mode = Mode::kSpinning, .amplifiers_enabled = true, .speed_rad_per_s = kSpeed};
  EXPECT_EQ(desk.Next(view).command, OperatorCommand::kSpin);
  EXPECT_EQ(desk.end_state(), EndState::kBraking);
  view = {.cycle = 200, .mode = Mode::kTripped, .speed_rad_per_s = kSpeed};
  EXPECT_EQ(desk.Next(view).command, OperatorCommand::kNone);
  EXPECT_EQ(desk.end_state(), EndState::kAwaitingStandstill);
  view = {
      .cycle = 400, .mode = Mode::kSpinning, .amplifiers_enabled = true, .speed_rad_per_s = kSpeed};
  EXPECT_EQ(desk.Next(view).command, OperatorCommand::kSpin);
  EXPECT_EQ(desk.end_state(), EndState::kBraking);
}

}  // namespace
}  // namespace levitas::loop
