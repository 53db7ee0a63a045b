// Trend and rise of numbers that are known, without records.
#include "analysis/records/condition_trend.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/random.hpp"
#include "tests/support/geared_rigs.hpp"

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

// Distribution-free: what it states it covers, of noise with tails that have no mean, too.
TEST(RobustSlope, CoversTheTrueSlopeAsOftenAsItSays) {
  constexpr double kTrue = 0.3;
  constexpr int kSeries = 3000;
  Random random(17);
  for (const bool cauchy : {false, true}) {
    for (const std::size_t count : {5U, 8U}) {
      int covered = 0;
      double stated = 0.0;
      for (int n = 0; n < kSeries; ++n) {
        std::vector<double> values;
        for (std::size_t i = 0; i < count; ++i) {
          const double noise = random.Normal() / (cauchy ? random.Normal() : 1.0);
          values.push_back(kTrue * static_cast<double>(i) + noise);
        }
        const Slope slope = RobustSlope(values, 0.9);
        covered += slope.low <= kTrue && kTrue <= slope.high;
        stated = slope.coverage;
      }
      EXPECT_GE(stated, 0.9);
      const double scatter = std::sqrt(stated * (1.0 - stated) / kSeries);
      EXPECT_NEAR(static_cast<double>(covered) / kSeries, stated, 4.0 * scatter) << count;
    }
  }
}

// Two and three values have 2 and 6 orders, of which one each leaves nothing below and above.
TEST(RobustSlope, SaysWhatFewValuesAllow) {
  EXPECT_NEAR(RobustSlope({1.0, 4.0}, 0.9).coverage, 0.0, 1e-12);
  const Slope three = RobustSlope({1.0, 4.0, 5.0}, 0.9);
  EXPECT_NEAR(three.coverage, 1.0 - 2.0 / 6.0, 1e-12);
  EXPECT_EQ(three.low, 1.0);
  EXPECT_EQ(three.high, 3.0);
}

TEST(FollowCondition, TakesItsTrendFromAmplitudes) {
  std::vector<GearCondition> sessions;
  for (const double amplitude : {3.0, 3.5, 4.0, 4.5, 5.0}) {
    sessions.push_back(Session(0, amplitude * amplitude / 20.0));  // of twenty lines
  }
  const auto trends = FollowCondition(sessions, {});
  EXPECT_NEAR(trends[1].amplitude_m.value, 0.5, 1e-12);
  EXPECT_NEAR(trends[1].amplitude_m.low, 0.5, 1e-12);
  EXPECT_EQ(trends[0].amplitude_m.value, 0.0);
  // Energies below 0, as noise makes them, are no amplitude.
  sessions[0].shafts[1].energy_m2.value = -4.0;
  EXPECT_EQ(sessions[0].shafts[1].Amplitude(), 0.0);
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

/// A session of the geared rig with a static load on the last axis.
GearCondition Loaded(double position_m, double current_a) {
  GearCondition of = Session(0, 0);
  of.mean_position_m = {0.0, 0.0, 0.0, position_m};
  of.mean_current_a = {0.0, 0.0, 0.0, current_a};
  return of;
}

// Five per cent of clearance and bias, half of one of speed, a quarter of the mesh: less is the
// same state, more is named.
TEST(Reasons, BeginWhereTheHeadOfTheFileSays) {
  plant::PlantConfig rig = levitas::test::GearedRotor4();
  for (auto& bearing : rig.bearings) bearing.touchdown.clearance_m = 400e-6;  // bias 1 A
  const GearCondition first = Loaded(0.0, 0.0);
  GearCondition slower = first;
  slower.speed_rad_per_s *= 1.0 - 0.0049;
  GearCondition softer = first;
  softer.mesh_m *= 0.76;
  EXPECT_TRUE(Reasons({first, Loaded(19e-6, 0.049), slower, softer}, rig).empty());
  slower.speed_rad_per_s = first.speed_rad_per_s * (1.0 - 0.0051);
  softer.mesh_m = 0.74 * first.mesh_m;
  GearCondition backwards = first;
  backwards.speed_rad_per_s *= -1.0;
  using testing::HasSubstr;
  EXPECT_THAT(
      Reasons({first, Loaded(21e-6, 0.0), Loaded(0.0, -0.051), slower, softer, backwards}, rig),
      testing::ElementsAre(HasSubstr("session 2: mean position or current of g_y"),
                           HasSubstr("session 3: mean position or current of g_y"),
                           HasSubstr("session 4: speed"), HasSubstr("session 5: lines of the mesh"),
                           HasSubstr("session 6: speed")));
}

}  // namespace
}  // namespace levitas::analysis
