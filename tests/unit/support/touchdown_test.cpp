#include "plant_sim/support/touchdown.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"

namespace levitas::support {
namespace {

constexpr Touchdown kBearing{190e-6, 1e7, 2000.0, 0.2, 0.012};

TEST(Touches, OnlyBeyondTheClearanceInAnyDirection) {
  EXPECT_FALSE(Touches(kBearing, 189e-6, 0.0));
  EXPECT_TRUE(Touches(kBearing, 0.0, -191e-6));
  EXPECT_FALSE(Touches(kBearing, 130e-6, 130e-6));  // 184 um
  EXPECT_TRUE(Touches(kBearing, -140e-6, 140e-6));  // 198 um
}

TEST(Push, IsTheSpringAtRest) {
  const Contact c = Push(kBearing, -200e-6, 0.0, 0.0, 0.0, 0.0);
  EXPECT_NEAR(c.normal_n, 100.0, 1e-9);  // 10 um at 1e7 N/m
  EXPECT_NEAR(c.x_n, 100.0, 1e-9);
  EXPECT_NEAR(c.y_n, 0.0, 1e-9);
}

TEST(Push, NeverPullsHoweverTheJournalMoves) {
  Random random(20261121);
  for (int i = 0; i < 100'000; ++i) {
    const double angle = 6.283 * random.Uniform();
    const double radius_m = 190e-6 + 20e-6 * random.Uniform();
    const double x_m = radius_m * std::cos(angle);
    const double y_m = radius_m * std::sin(angle);
    const Contact c = Push(kBearing, x_m, y_m, random.Uniform() - 0.5, random.Uniform() - 0.5,
                           600.0 * (random.Uniform() - 0.5));
    EXPECT_GE(c.normal_n, 0.0);
    EXPECT_LE(c.x_n * x_m + c.y_n * y_m, 1e-15);  // never outward; rounding of two products
  }
}

TEST(Push, LetsGoWhenTheJournalLeavesFasterThanTheSpringFollows) {
  // 1 um deep is 10 N of spring; leaving at 0.1 m/s the damper would pull with 200 N.
  const Contact c = Push(kBearing, 191e-6, 0.0, -0.1, 0.0, 0.0);
  EXPECT_EQ(c.normal_n, 0.0);
  EXPECT_EQ(c.x_n, 0.0);
  EXPECT_EQ(c.y_n, 0.0);
}

TEST(Push, FrictionOpposesTheRotatingSurface) {
  // Touching at +x, turning from x to y: the surface runs towards +y, friction points to -y and
  // drives the journal into backward whirl.
  const Contact c = Push(kBearing, 200e-6, 0.0, 0.0, 0.0, 300.0);
  EXPECT_NEAR(c.y_n, -0.2 * 100.0, 1e-3 * 20.0);  // smoothing: (v0/v)^2/2 = 4e-6
  const Contact reversed = Push(kBearing, 200e-6, 0.0, 0.0, 0.0, -300.0);
  EXPECT_NEAR(reversed.y_n, -c.y_n, 1e-12);
}

TEST(Push, FrictionVanishesWhenTheJournalRollsInTheBearing) {
  // Backward whirl at the speed of its surface: no sliding.
  const Contact c = Push(kBearing, 200e-6, 0.0, 0.0, -300.0 * 0.012, 300.0);
  EXPECT_NEAR(c.y_n, 0.0, 1e-9);
}

TEST(Push, FrictionNeverExceedsCoulombsLimit) {
  for (const double sliding : {1e-4, 1e-2, 1.0, 100.0}) {
    const Contact c = Push(kBearing, 0.0, 200e-6, sliding, 0.0, 0.0);
    EXPECT_LE(std::abs(c.x_n), 0.2 * c.normal_n);
    EXPECT_LT(c.x_n, 0.0);
  }
}

}  // namespace
}  // namespace levitas::support
