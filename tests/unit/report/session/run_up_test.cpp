#include "report/session/run_up.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "tests/unit/report/session/whirling_rotor.hpp"

namespace levitas::report {
namespace {

using test::WhirlingRotor;

// A window may end up to one sample, 0.04 rad at 400 rad/s, beside its 25 rad of whole turns; the
// offset of twice the radius then leaves 2 x 0.04 / 25.
constexpr double kShare = 0.01;

TEST(Synchronous, FindsTheCircleThatTurnsWithTheRotorAndLeavesOutItsMiddle) {
  const auto points = Synchronous(WhirlingRotor());
  ASSERT_GT(points.size(), 20U);
  for (const SynchronousPoint& point : points) {
    EXPECT_NEAR(std::abs(point.forward_m.at(0)), test::kRadiusM, kShare * test::kRadiusM);
    EXPECT_NEAR(std::arg(point.forward_m.at(0)), test::kLeadRad, 2.0 * kShare);
  }
}

TEST(Synchronous, SeesNothingOfABackwardWhirl) {
  test::Whirl backward;
  backward.direction = -1.0;
  for (const SynchronousPoint& point : Synchronous(WhirlingRotor(backward))) {
    EXPECT_LT(std::abs(point.forward_m.at(0)), kShare * test::kRadiusM);
  }
}

// A second bearing on a shaft that the first one drives: its own circle, which turns at `ratio`
// times the angle, and three times as large a circle that turns with the first shaft.
Recording Geared(double ratio) {
  Recording r = WhirlingRotor();
  r.rig.channels = {"p_x", "p_y", "g_x", "g_y"};
  r.rig.bearings = {"p", "g"};
  r.shaft_ratio = {1.0, ratio};
  r.position_m.resize(4);
  double angle_rad = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double own_rad = ratio * angle_rad + test::kLeadRad;
    r.position_m[2].push_back(
        static_cast<float>(test::kRadiusM * (std::cos(own_rad) + 3.0 * std::cos(angle_rad))));
    r.position_m[3].push_back(
        static_cast<float>(test::kRadiusM * (std::sin(own_rad) + 3.0 * std::sin(angle_rad))));
    angle_rad += static_cast<double>(r.speed_rad_per_s[i]) * 1e-4;
  }
  return r;
}

// Of the circles beside it some 7 rad of the first shaft's angle may be left over: whole turns of
// one shaft are not whole turns of the other. 3 x 7 of at least 50 rad, as a share of the radius,
// were it all on one side; the circle itself turns over in that angle, which leaves a third of it.
constexpr double kOtherShaft = 0.15;

TEST(Synchronous, FollowsADrivenShaftByItsOwnAngleAndSense) {
  for (const double ratio : {-0.5, -0.8, 0.5}) {
    const auto points = Synchronous(Geared(ratio));
    ASSERT_GT(points.size(), 10U);
    for (const SynchronousPoint& point : points) {
      const auto lead = std::polar(test::kRadiusM, test::kLeadRad);
      EXPECT_LT(std::abs(point.forward_m.at(1) - lead), kOtherShaft * test::kRadiusM) << ratio;
      EXPECT_NEAR(std::abs(point.forward_m.at(0)), test::kRadiusM, kShare * test::kRadiusM);
    }
  }
}

TEST(Synchronous, TakesADrivenShaftThatTurnsTheOtherWayForAnother) {
  for (const SynchronousPoint& point : Synchronous(Geared(-0.5))) {
    EXPECT_GT(std::abs(point.forward_m.at(1)), 0.8 * test::kRadiusM);
  }
  Recording wrong = Geared(-0.5);
  wrong.shaft_ratio = {1.0, 0.5};
  for (const SynchronousPoint& point : Synchronous(wrong)) {
    EXPECT_LT(std::abs(point.forward_m.at(1)), kOtherShaft * test::kRadiusM);
  }
}

TEST(Synchronous, TellsARunUpFromASteadySpeedAndARunDown) {
  const auto points = Synchronous(WhirlingRotor());
  EXPECT_EQ(points.front().ramp, Ramp::kUp);
  EXPECT_EQ(points.back().ramp, Ramp::kSteady);
  Recording down = WhirlingRotor();
  std::reverse(down.speed_rad_per_s.begin(), down.speed_rad_per_s.end());
  std::reverse(down.angle_rad.begin(), down.angle_rad.end());
  EXPECT_EQ(Synchronous(down).back().ramp, Ramp::kDown);
}

TEST(Synchronous, HasNoPointsOfARotorThatStandsOrIsNotLevitated) {
  test::Whirl standing;
  standing.top_rad_per_s = 1.0;
  EXPECT_TRUE(Synchronous(WhirlingRotor(standing)).empty());
  Recording lying = WhirlingRotor();
  lying.levitated.assign(lying.size(), false);
  EXPECT_TRUE(Synchronous(lying).empty());
}

TEST(Synchronous, PutsNoWindowAcrossAGap) {
  Recording gap = WhirlingRotor();
  constexpr std::size_t kGapAt = 30'000;
  for (std::size_t i = kGapAt; i < gap.size(); ++i) gap.cycle[i] += 1'000;
  // Half the shortest window lies on either side of its middle.
  const auto half = static_cast<std::size_t>(0.5 * kLeastS * 1e4) - 1;
  for (const SynchronousPoint& point : Synchronous(gap)) {
    EXPECT_TRUE(point.index + half < kGapAt || point.index >= kGapAt + half) << point.index;
  }
}

}  // namespace
}  // namespace levitas::report
