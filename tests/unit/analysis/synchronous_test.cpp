// Signals in closed form: a known amplitude at each order, over whole turns and over a ramp.

#include "analysis/synchronous.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace levitas::analysis {
namespace {

constexpr double kPeriodS = 1e-4;
constexpr double kOnceM = 12e-6;
constexpr double kThriceM = 3e-6;
constexpr double kMeanM = 4e-6;
constexpr double kOnceA = 0.2;

/// One bearing of two axes. x holds a mean, 1x and 3x; y a quarter turn later; the current 1x.
class Made {
 public:
  Made() {
    recording.name = "made by formula";
    recording.period_ns = 100'000;
    recording.channels = {"de_x", "de_y"};
    for (auto* columns : {&recording.position_m, &recording.current_a, &recording.excitation_a,
                          &recording.excitation_m}) {
      columns->assign(2, {});
    }
  }

  /// So long, while the speed changes evenly.
  Made& Then(double seconds, double from_rad_per_s, double to_rad_per_s) {
    const auto rows = static_cast<std::size_t>(std::lround(seconds / kPeriodS));
    for (std::size_t n = 0; n < rows; ++n) {
      const double share = static_cast<double>(n) / static_cast<double>(rows);
      Row(from_rad_per_s + share * (to_rad_per_s - from_rad_per_s));
    }
    return *this;
  }

  session::Recording recording;
  double shaft{1.0};  ///< what the signals turn with, over the recorded angle

 private:
  void Row(double speed_rad_per_s) {
    const double at = shaft * angle_rad_;
    recording.cycle.push_back(recording.cycle.size());
    recording.levitated.push_back(1);
    recording.amplifiers_enabled.push_back(1);
    recording.speed_rad_per_s.push_back(speed_rad_per_s);
    recording.angle_rad.push_back(std::remainder(angle_rad_, 2.0 * std::numbers::pi));
    recording.bias_current_a.push_back(1.0);
    recording.position_m[0].push_back(kMeanM + kOnceM * std::cos(at + 0.7) +
                                      kThriceM * std::cos(3.0 * at));
    recording.position_m[1].push_back(kOnceM * std::sin(at + 0.7) + kThriceM * std::sin(3.0 * at));
    recording.current_a[0].push_back(kOnceA * std::cos(at - 1.0));
    recording.current_a[1].push_back(kOnceA * std::sin(at - 1.0));
    angle_rad_ += speed_rad_per_s * kPeriodS;
  }

  double angle_rad_{};
};

SynchronousRequest Orders(std::vector<double> orders) {
  SynchronousRequest request;
  request.orders = std::move(orders);
  return request;
}

TEST(Synchronous, FindsTheAmplitudeOfEveryOrderAtASpeedThatIsHeld) {
  Made made;
  made.Then(0.5, 0.0, 0.0).Then(1.0, 0.0, 300.0).Then(1.0, 300.0, 300.0);
  const SynchronousAnalysis analysis(made.recording, Orders({1.0, 3.0}));
  ASSERT_EQ(analysis.HeldSpeeds().size(), 2U);
  EXPECT_EQ(analysis.HeldSpeeds()[0], 0.0);
  EXPECT_NEAR(analysis.HeldSpeeds()[1], 300.0, 0.6);  // 0.2 % counts as held
  const auto found = analysis.At(300.0);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->held);
  // The signals are sums of the fitted functions alone: rounding is left.
  for (std::size_t axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(found->position_m[axis].amplitude[0], kOnceM, 1e-12);
    EXPECT_NEAR(found->position_m[axis].amplitude[1], kThriceM, 1e-12);
    EXPECT_NEAR(found->current_a[axis].amplitude[0], kOnceA, 1e-9);
    EXPECT_NEAR(found->current_a[axis].amplitude[1], 0.0, 1e-9);
  }
  EXPECT_NEAR(found->position_m[0].mean, kMeanM, 1e-12);
  double radius_m = 0.0;
  for (double at = 0.0; at < 2.0 * std::numbers::pi; at += 1e-3) {
    radius_m = std::max(
        radius_m, std::abs(kMeanM + std::polar(kOnceM, at + 0.7) + std::polar(kThriceM, 3.0 * at)));
  }
  // A sample turns by 0.03 rad: at most half of it off the peak, 1e-4 of the parts that turn.
  EXPECT_NEAR(found->largest_radius_m[0], radius_m, 0.02e-6);
}

TEST(Synchronous, GivesNoOrdersButTheMeanOfARotorThatStands) {
  Made made;
  made.Then(0.5, 0.0, 0.0);
  const auto found = SynchronousAnalysis(made.recording, Orders({1.0})).At(0.0);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->position_m[0].amplitude.empty());
  EXPECT_NEAR(found->current_a[0].mean, kOnceA * std::cos(1.0), 1e-12);
}

TEST(Synchronous, TakesASpeedThatIsOnlyPassedFromTheWindowNearestToIt) {
  Made made;
  made.Then(4.0, 20.0, 420.0);
  const SynchronousAnalysis analysis(made.recording, Orders({1.0}));
  EXPECT_TRUE(analysis.HeldSpeeds().empty());
  const auto found = analysis.At(250.0);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->held);
  EXPECT_NEAR(found->speed_rad_per_s, 250.0, 5.0);  // 2 %
  // 3x is not fitted here; over four turns it leaks in by the change of speed within them, a few
  // per cent.
  EXPECT_NEAR(found->position_m[0].amplitude[0], kOnceM, 0.03 * kOnceM);
  EXPECT_FALSE(analysis.At(600.0));
  EXPECT_FALSE(analysis.At(0.0));
}

TEST(Synchronous, LeavesOutRowsWithATestSignalAndOnlyThose) {
  Made made;
  made.Then(1.0, 300.0, 300.0);
  const std::size_t shaken = made.recording.rows();
  made.Then(3.0, 300.0, 300.0);
  auto& r = made.recording;
  for (std::size_t row = shaken; row < r.rows(); ++row) r.position_m[0][row] += 50e-6;
  const auto without = SynchronousAnalysis(r, Orders({1.0})).At(300.0);
  ASSERT_TRUE(without);
  EXPECT_GT(without->largest_radius_m[0], 50e-6);  // nothing says that it is a test signal
  r.excitation_a[0].assign(r.rows(), 0.0);
  for (std::size_t row = shaken; row < r.rows(); ++row) r.excitation_a[0][row] = 0.1;
  const auto with = SynchronousAnalysis(r, Orders({1.0})).At(300.0);
  ASSERT_TRUE(with);
  EXPECT_LT(with->largest_radius_m[0], 20e-6);
  EXPECT_LE(with->rows.end, shaken);
}

TEST(Synchronous, FollowsTheBearingsOwnShaftThroughGears) {
  Made made;
  made.shaft = -0.4;
  made.Then(2.0, 300.0, 300.0);
  SynchronousRequest request = Orders({1.0, 3.0});
  const auto first = SynchronousAnalysis(made.recording, request).At(300.0);
  request.shaft_ratio = {-0.4};
  const auto own = SynchronousAnalysis(made.recording, request).At(300.0);
  ASSERT_TRUE(first && own);
  EXPECT_LT(first->position_m[0].amplitude[0], 0.1 * kOnceM);  // it turns otherwise
  EXPECT_NEAR(own->position_m[0].amplitude[0], kOnceM, 1e-12);
  EXPECT_NEAR(own->position_m[0].amplitude[1], kThriceM, 1e-12);
}

TEST(Synchronous, HasNoNumberForAnOrderBeyondHalfTheSamplingRate) {
  Made made;
  made.Then(0.5, 600.0, 600.0);
  const auto found = SynchronousAnalysis(made.recording, Orders({1.0, 60.0})).At(600.0);
  ASSERT_TRUE(found);
  EXPECT_FALSE(std::isnan(found->position_m[0].amplitude[0]));
  EXPECT_TRUE(std::isnan(found->position_m[0].amplitude[1]));  // 5730 Hz of 5000
}

TEST(Synchronous, HoldsNoSpeedOfASlowRamp) {
  Made made;
  made.Then(6.0, 300.0, 306.0);  // 1 rad/s2: 0.2 % in 0.6 s
  EXPECT_TRUE(SynchronousAnalysis(made.recording, Orders({1.0})).HeldSpeeds().empty());
}

TEST(Synchronous, RefusesAnOrderThatIsNone) {
  Made made;
  made.Then(0.1, 300.0, 300.0);
  EXPECT_THROW(SynchronousAnalysis(made.recording, Orders({0.0})), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::analysis
