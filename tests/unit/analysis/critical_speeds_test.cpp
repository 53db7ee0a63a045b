#include "analysis/critical_speeds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/free_modes.hpp"
#include "analysis/poles.hpp"
#include "tests/support/geared_rigs.hpp"
#include "tests/support/test_rigs.hpp"
#include "tests/unit/analysis/laws.hpp"

namespace levitas::analysis {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Straight lines f0 +- g W/2 pi meet W/2 pi at W = 2 pi f0/(1 -+ g).
TEST(Crossings, OfStraightLinesStandWhereTheFormulaHasThem) {
  const auto modes = [](double speed) {
    const double split = 0.2 * speed / kTurn;
    return std::vector<CampbellMode>{{50.0 - split, 0.01, 0.0, 0.0},
                                     {50.0 + split, 0.01, 1.0, 0.0}};
  };
  const Campbell campbell = CampbellOf(modes, kTurn * 100.0, 7);
  ASSERT_EQ(campbell.crossings.size(), 2U);
  EXPECT_NEAR(campbell.crossings[0].speed_rad_per_s, kTurn * 50.0 / 1.2, 1e-5);
  EXPECT_NEAR(campbell.crossings[1].speed_rad_per_s, kTurn * 50.0 / 0.8, 1e-5);
  EXPECT_STREQ(WhirlName(campbell.crossings[0].mode), "backward");
  EXPECT_STREQ(WhirlName(campbell.crossings[1].mode), "forward");
}

// A line f0 meets r times the rotation at W = 2 pi f0/r.
TEST(Crossings, OfEveryOrderStandWhereItMeetsTheMode) {
  const auto modes = [](double) { return std::vector<CampbellMode>{{60.0, 0.01, 1.0, 0.0}}; };
  const Campbell campbell =
      CampbellOf(modes, kTurn * 100.0, 7, {{"1x", 1.0}, {"wheel", 0.5}, {"mesh", 20.0}});
  ASSERT_EQ(campbell.crossings.size(), 2U);  // half of the rotation is 50 Hz at most
  EXPECT_NEAR(campbell.crossings[0].speed_rad_per_s, kTurn * 3.0, 1e-6);
  EXPECT_EQ(campbell.orders[campbell.crossings[0].order].name, "mesh");
  EXPECT_NEAR(campbell.crossings[1].speed_rad_per_s, kTurn * 60.0, 1e-5);
  EXPECT_EQ(campbell.orders[campbell.crossings[1].order].name, "1x");
}

TEST(Orders, OfGearedShaftsAreTheirRotationAndTheTeeth) {
  const auto rig = test::GearedRotor8();
  const auto& pair = rig.gears.at(0);
  const std::vector<Order> orders = OrdersOf(rig);
  ASSERT_EQ(orders.size(), 3U);
  EXPECT_DOUBLE_EQ(orders[0].per_turn, 1.0);
  // Teeth that mesh pass at the same rate on both wheels.
  EXPECT_DOUBLE_EQ(orders[1].per_turn * pair.driven.teeth, orders[2].per_turn);
  EXPECT_DOUBLE_EQ(orders[0].per_turn * pair.driving.teeth, orders[2].per_turn);
  ASSERT_EQ(OrdersOf(test::QuietFlexibleRotor()).size(), 1U);
}

TEST(Crossings, AreNotWhereOneModeEndsAndAnotherBegins) {
  const auto modes = [](double speed) {
    const double hz = speed < kTurn * 33.0 ? 60.0 : 10.0;  // jumps over 1x
    return std::vector<CampbellMode>{{hz, 0.01, 1.0, 0.0}};
  };
  EXPECT_TRUE(CampbellOf(modes, kTurn * 50.0, 10).crossings.empty());
}

TEST(Crossings, OfModesThatNeverMeetRotationAreNone) {
  const auto above = [](double speed) {
    return std::vector<CampbellMode>{{10.0 + 1.1 * speed / kTurn, 0.0, 1.0, 0.0}};
  };
  EXPECT_TRUE(CampbellOf(above, kTurn * 500.0, 20).crossings.empty());
  const auto none = [](double) { return std::vector<CampbellMode>{}; };
  EXPECT_TRUE(CampbellOf(none, kTurn * 500.0, 20).crossings.empty());
}

TEST(Crossings, FollowModesThatExchangeTheirPlacesInTheList) {
  // Sorted by frequency, as an eigenvalue solver gives them; the two lines cross at 25 Hz.
  const auto modes = [](double speed) {
    const double hz = speed / kTurn;
    std::vector<CampbellMode> all{{40.0, 0.3, 1.0, 0.0}, {15.0 + hz * 1.5, 0.01, 1.0, 0.0}};
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return a.frequency_hz < b.frequency_hz; });
    return all;
  };
  const Campbell campbell = CampbellOf(modes, kTurn * 60.0, 12);
  ASSERT_EQ(campbell.crossings.size(), 1U);  // the rising line is always above 1x
  EXPECT_NEAR(campbell.crossings[0].speed_rad_per_s, kTurn * 40.0, 1e-5);
  EXPECT_DOUBLE_EQ(campbell.crossings[0].mode.damping_ratio, 0.3);
}

// The speeds found are where the modes that the command prints equal the rotation.
TEST(FreeCampbell, CrossesWhereTheFreeModesEqualTheRotation) {
  const auto rig = test::QuietFlexibleRotor();
  const Campbell campbell = FreeCampbell(rig, kTurn * 130.0, 3);
  ASSERT_EQ(campbell.crossings.size(), 2U);  // the first bending mode near 90 Hz, both whirls
  for (const CriticalSpeed& crossing : campbell.crossings) {
    const auto at = ComputeFreeModes(rig, {crossing.speed_rad_per_s}, 1).whirl[0];
    const bool forward = crossing.mode.forward_share > 0.5;
    EXPECT_NEAR(kTurn * (forward ? at.forward_hz : at.backward_hz)[0], crossing.speed_rad_per_s,
                1e-6 * crossing.speed_rad_per_s);
  }
}

TEST(FreeCampbell, OfARotorWithoutBendingModesIsEmpty) {
  auto rig = test::QuietFlexibleRotor();
  rig.rotor.given = rotor::GivenRotor{2.0, 0.01, 0.002, 0.2, {}, {}};
  const Campbell campbell = FreeCampbell(rig, kTurn * 100.0, 4);
  EXPECT_TRUE(campbell.crossings.empty());
  for (const auto& at : campbell.speeds) EXPECT_TRUE(at.modes.empty());
}

TEST(LevitatedCampbell, CrossesWhereAPoleOfTheLoopEqualsTheRotation) {
  const auto rig = test::QuietFlexibleRotor();
  const auto law = test::FlexibleRotorLaw();
  const Campbell campbell = LevitatedCampbell(rig, law, kTurn * 130.0);
  ASSERT_FALSE(campbell.crossings.empty());
  for (const CriticalSpeed& crossing : campbell.crossings) {
    double nearest = 1e9;
    for (const Pole& pole : ClosedLoopPoles(rig, law, crossing.speed_rad_per_s).poles) {
      const double off = std::abs(kTurn * std::abs(pole.frequency_hz) - crossing.speed_rad_per_s);
      nearest = std::min(nearest, off);
    }
    EXPECT_LT(nearest, 1e-5 * crossing.speed_rad_per_s);
    EXPECT_LT(crossing.mode.damping_ratio, std::sqrt(0.5));
  }
}

}  // namespace
}  // namespace levitas::analysis
