#include "report/session/run_up.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "whirling_rotor.hpp"

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
