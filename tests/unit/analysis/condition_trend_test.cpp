// Trend and rise of numbers that are known, without records.
#include "analysis/records/condition_trend.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace levitas::analysis {
namespace {

/// A session of two shafts, of which the first has no line of its own; energies per line.
GearCondition Session(double first_m2, double second_m2, std::size_t lines = 20) {
  GearCondition of;
  of.speed_rad_per_s = 180.0;
  of.repeats = 10;
  of.mesh_m = 1e-6;
  for (std::size_t s = 0; s < 2; ++s) {
    ShaftCondition shaft;
    shaft.shaft = s;
    const double each = s == 0 ? first_m2 : second_m2;
    shaft.line_m2.assign(20, 0.0);
    for (std::size_t k = 0; k < lines; ++k) shaft.line_m2[k] = each;
    shaft.energy_m2 = {each * static_cast<double>(lines), 1.0};
    shaft.once_m = 1.0;
    of.shafts.push_back(shaft);
  }
  of.shafts[0].shared = {1};
  return of;
}

// Pairs of 0, 1, 2, 30: slopes 1, 1, 1, 10, 14.5, 28; the outlier does not move the median far.
TEST(RobustSlope, IsTheMedianOfAllPairs) {
  const Slope slope = RobustSlope({0.0, 1.0, 2.0, 30.0}, 0.9);
  EXPECT_DOUBLE_EQ(slope.value, 0.5 * (1.0 + 10.0));
  EXPECT_DOUBLE_EQ(slope.low, 1.0);
  EXPECT_DOUBLE_EQ(slope.high, 28.0);
  // All of 4! orders but the two that are monotonic.
  EXPECT_NEAR(slope.coverage, 1.0 - 2.0 / 24.0, 1e-12);
}

// Kendall's S of ten values, tables of Hollander & Wolfe 1973: P(S >= 21) = 0.036, P(S >= 19) =
// 0.054: the interval at 90 % leaves out 12 of 45 slopes at either end.
TEST(RobustSlope, TakesItsIntervalFromKendallsDistribution) {
  std::vector<double> values;
  for (int i = 0; i < 10; ++i) values.push_back(i * i);  // slopes of all pairs are i + k
  const Slope slope = RobustSlope(values, 0.9);
  std::vector<double> sums;
  for (int i = 0; i < 10; ++i) {
    for (int k = i + 1; k < 10; ++k) sums.push_back(i + k);
  }
  std::sort(sums.begin(), sums.end());
  EXPECT_NEAR(slope.coverage, 1.0 - 2.0 * 0.036, 1e-3);
  EXPECT_DOUBLE_EQ(slope.low, sums[12]);
  EXPECT_DOUBLE_EQ(slope.high, sums[45 - 13]);
}

TEST(FollowCondition, NamesTheShaftWhoseOwnLinesRise) {
  const std::vector of_second{Session(0, 0), Session(0, 0), Session(0, 0), Session(1, 1)};
  const auto second = FollowCondition(of_second, {});
  ASSERT_EQ(second.size(), 2U);
  EXPECT_TRUE(second[1].risen);
  EXPECT_FALSE(second[0].risen);
  EXPECT_EQ(second[0].explained_by, 1U);
  EXPECT_FALSE(second[1].or_else);
  TrendRule unloaded;
  unloaded.loaded = false;
  EXPECT_EQ(FollowCondition(of_second, unloaded)[1].or_else, 0U);
  const auto first =
      FollowCondition({Session(0, 0), Session(0, 0), Session(0, 0), Session(1, 0)}, {});
  EXPECT_TRUE(first[0].risen);
  EXPECT_FALSE(first[1].risen);
}

// Two pulses a turn, like or opposite: even multiples grow by far more, or far less, than odd ones.
TEST(FollowCondition, NamesTheShaftThatPulsesTwiceATurnOfTheOther) {
  for (const double even : {9.0, 0.1}) {
    const auto trend =
        FollowCondition({Session(0, 0), Session(0, 0), Session(0, 0), Session(even, 1)}, {});
    EXPECT_TRUE(trend[0].risen) << even;
    EXPECT_FALSE(trend[1].risen) << even;
    EXPECT_EQ(trend[1].explained_by, 0U) << even;
  }
}

TEST(FollowCondition, DoesNotTakeOneLineForAPulse) {
  const auto trend =
      FollowCondition({Session(0, 0), Session(0, 0), Session(0, 0), Session(0, 40, 1)}, {});
  EXPECT_GT(trend[1].rise.back(), 20.0);
  EXPECT_FALSE(trend[1].risen);
}

TEST(FollowCondition, KnowsTheScatterOfTheFirstSessions) {
  const std::vector scattered{Session(0, 0), Session(0, 1), Session(0, 2), Session(0, 2)};
  EXPECT_FALSE(FollowCondition(scattered, {})[1].risen);
  EXPECT_TRUE(FollowCondition({Session(0, 0), Session(0, 1)}, {}).empty());
}

TEST(Reasons, NameWhatDiffersBetweenSessions) {
  const plant::PlantConfig rig;
  EXPECT_TRUE(Reasons({Session(0, 0), Session(1, 1)}, rig).empty());
  GearCondition faster = Session(0, 0);
  faster.speed_rad_per_s *= 1.02;
  GearCondition loaded = Session(0, 0);
  loaded.mesh_m *= 1.5;
  GearCondition brief;
  EXPECT_THAT(Reasons({Session(0, 0), faster, loaded, brief}, rig),
              testing::ElementsAre(testing::HasSubstr("session 2: speed 1753"),
                                   testing::HasSubstr("session 3: lines of the mesh 1.5 um"),
                                   testing::HasSubstr("session 4: holds its speed for 0")));
}

}  // namespace
}  // namespace levitas::analysis
