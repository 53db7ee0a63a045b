#include "controller/loop/run_down.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace levitas::loop {
namespace {

constexpr double kPeriodS = 1e-3;
constexpr double kStandstill = 0.5;  // rad/s

/// A rotor that slows down at `rate` from `speed`, and frames of it that `spoil` may change.
class Falling {
 public:
  Falling(double file_rate, double true_rate, double speed)
      : run_down_({.period_s = kPeriodS,
                   .deceleration_rad_per_s2 = file_rate,
                   .standstill_rad_per_s = kStandstill,
                   .landing_ramp_s = 1.0}),
        rate_(true_rate),
        speed_(speed) {
    Look(speed_);
    run_down_.Begin(0);
  }
  /// Another second.
  template <class Spoil>
  void Second(const Spoil& spoil) {
    for (int i = 0; i < 1000; ++i) {
      ++cycle_;
      speed_ = std::max(0.0, speed_ - rate_ * kPeriodS);
      Look(spoil(cycle_, speed_));
    }
  }
  void Seconds(int count) {
    for (int i = 0; i < count; ++i) {
      Second([](std::uint64_t, double speed) { return speed; });
    }
  }
  void Look(double speed) { run_down_.Look(cycle_, speed, std::abs(speed) < kStandstill); }
  [[nodiscard]] bool Overdue() const { return run_down_.Overdue(cycle_); }
  [[nodiscard]] bool BrakeFails() const { return run_down_.brake_fails(); }
  [[nodiscard]] double speed() const { return speed_; }

 private:
  RunDown run_down_;
  double rate_, speed_;
  std::uint64_t cycle_{0};
};

// 300 rad/s at 0.4 rad/s2 takes 750 s: more than any limit in seconds that suits a faster rig.
TEST(RunDown, ARotorThatTakesMinutesToRunDownIsNeverOverdueAndItsBrakeNeverFails) {
  Falling rotor(0.4, 0.4, 300.0);
  for (int second = 0; second < 749; ++second) {
    rotor.Seconds(1);
    ASSERT_FALSE(rotor.Overdue()) << second;
    ASSERT_FALSE(rotor.BrakeFails()) << second;
  }
}

TEST(RunDown, ALandingIsNotOverdueWhileTheSpeedFallsHoweverSlowlyComparedToTheFiles) {
  Falling rotor(100.0, 0.5, 300.0);  // 3 s by the files, 600 s in truth
  for (int second = 0; second < 595; ++second) {
    rotor.Seconds(1);
    ASSERT_FALSE(rotor.Overdue()) << second;
  }
}

TEST(RunDown, ALandingOfARotorThatDoesNotSlowDownIsOverdueAfterTheTimeOfTheFilesAndNotBefore) {
  Falling rotor(10.0, 0.0, 300.0);
  rotor.Seconds(41);  // 30 s to run down, 1 s of ramp, 10 s of margin
  EXPECT_FALSE(rotor.Overdue());
  rotor.Seconds(1);
  EXPECT_TRUE(rotor.Overdue());
}

TEST(RunDown, ABrakeWithoutEffectIsFoundAndOneOfATenthOfItsRateIsNot) {
  Falling coasting(10.0, 0.9, 300.0);
  coasting.Seconds(2);
  EXPECT_TRUE(coasting.BrakeFails());
  Falling weak(10.0, 1.1, 300.0);
  weak.Seconds(100);
  EXPECT_FALSE(weak.BrakeFails());
}

TEST(RunDown, ARotorThatStandsHasNoBrakeThatFails) {
  Falling rotor(10.0, 0.0, 0.1);
  rotor.Seconds(20);
  EXPECT_FALSE(rotor.BrakeFails());
}

// Wherever it falls: also on the edge of a window, where the speed is compared.
TEST(RunDown, OneWrongFrameMakesNoBrakeFailAndNoLandingOverdue) {
  for (const double wrong : {0.0, 1e5, std::numeric_limits<double>::quiet_NaN()}) {
    for (std::uint64_t at = 1990; at < 2010; ++at) {
      Falling rotor(10.0, 10.0, 300.0);
      for (int second = 0; second < 25; ++second) {
        rotor.Second(
            [&](std::uint64_t cycle, double speed) { return cycle == at ? wrong : speed; });
        ASSERT_FALSE(rotor.BrakeFails()) << wrong << " in frame " << at;
        ASSERT_FALSE(rotor.Overdue()) << wrong << " in frame " << at;
      }
    }
  }
}

TEST(RunDown, ASpeedThatIsNoNumberIsNoFall) {
  Falling rotor(10.0, 10.0, 300.0);
  for (int second = 0; second < 3; ++second) {
    rotor.Second([](std::uint64_t, double) { return std::numeric_limits<double>::quiet_NaN(); });
  }
  EXPECT_TRUE(rotor.BrakeFails());
}

}  // namespace
}  // namespace levitas::loop
