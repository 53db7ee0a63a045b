#include "plant_sim/plant/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace levitas::plant {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

TEST(Drive, AcceleratesAtTheLimitAndStopsAtTheSetPoint) {
  Rotation r;
  for (int i = 0; i < 1000; ++i) {
    Drive(r, 50.0, 100.0, 1e-3);
    EXPECT_LE(r.speed_rad_per_s, 50.0);
    if (i == 249) {
      EXPECT_NEAR(r.speed_rad_per_s, 25.0, 1e-9);  // rounding of 250 sums
      EXPECT_DOUBLE_EQ(r.acceleration_rad_per_s2, 100.0);
    }
  }
  EXPECT_DOUBLE_EQ(r.speed_rad_per_s, 50.0);
  EXPECT_EQ(r.acceleration_rad_per_s2, 0.0);
  // 0.5 s of ramp, 0.5 s of holding: 12.5 + 25 rad.
  EXPECT_NEAR(r.angle_rad, std::fmod(37.5, kTwoPi), 1e-9);
}

TEST(Drive, BrakesTowardsALowerSetPointAndThroughZero) {
  Rotation r{10.0, 0.0, 0.0};
  Drive(r, -10.0, 100.0, 0.05);
  EXPECT_DOUBLE_EQ(r.speed_rad_per_s, 5.0);
  for (int i = 0; i < 10; ++i) Drive(r, -10.0, 100.0, 0.05);
  EXPECT_DOUBLE_EQ(r.speed_rad_per_s, -10.0);
}

TEST(Drive, WithoutALimitHoldsItsSpeed) {
  Rotation r{10.0, 0.0, 0.0};
  Drive(r, 99.0, 0.0, 1e-3);
  EXPECT_EQ(r.speed_rad_per_s, 10.0);
}

TEST(Coast, IsTheClosedFormOfViscousAndDryFriction) {
  DriveConfig drive{0.0, 0.2, 5.0};
  for (const double sign : {1.0, -1.0}) {
    Rotation r{sign * 300.0, 0.0, 0.0};
    double turned = 0.0;
    for (int i = 0; i < 10'000; ++i) {
      const double before = r.angle_rad;
      Coast(r, drive, 1e-4);
      turned += std::remainder(r.angle_rad - before, kTwoPi);
    }
    // After 1 s: (300 + 25) e^{-0.2} - 25, and its integral.
    const double gone = 1.0 - std::exp(-0.2);
    EXPECT_NEAR(r.speed_rad_per_s, sign * (300.0 - 325.0 * gone), 1e-8);  // 10 000 sums
    EXPECT_NEAR(turned, sign * (325.0 * gone / 0.2 - 25.0), 1e-7);
  }
}

TEST(Coast, StandsAfterTheTimeOfTheClosedForm) {
  const DriveConfig drive{0.0, 0.2, 5.0};
  const double stop_s = std::log1p(0.2 * 30.0 / 5.0) / 0.2;
  Rotation r{30.0, 0.0, 0.0};
  const auto steps = static_cast<int>(stop_s / 1e-3);
  for (int i = 0; i < steps; ++i) Coast(r, drive, 1e-3);
  EXPECT_GT(r.speed_rad_per_s, 0.0);
  Coast(r, drive, 1e-3);
  EXPECT_EQ(r.speed_rad_per_s, 0.0);
  const double angle_rad = r.angle_rad;
  Coast(r, drive, 1e-3);
  EXPECT_EQ(r.angle_rad, angle_rad);
  EXPECT_EQ(r.acceleration_rad_per_s2, 0.0);
}

TEST(Coast, WithDryFrictionAloneIsAParabola) {
  Rotation r{10.0, 0.0, 0.0};
  Coast(r, {0.0, 0.0, 4.0}, 1.0);
  EXPECT_DOUBLE_EQ(r.speed_rad_per_s, 6.0);
  EXPECT_NEAR(r.angle_rad, 8.0 - kTwoPi, 1e-14);
}

TEST(Coast, WithoutFrictionTurnsForEver) {
  Rotation r{10.0, 0.0, 0.0};
  Coast(r, {}, 1.0);
  EXPECT_DOUBLE_EQ(r.speed_rad_per_s, 10.0);
}

TEST(Wrapped, LiesInOneTurnForAnyAngle) {
  for (const double angle : {0.0, -1e-20, 7.0, -7.0, 1e6, kTwoPi, -kTwoPi}) {
    EXPECT_GE(Wrapped(angle), 0.0) << angle;
    EXPECT_LT(Wrapped(angle), kTwoPi) << angle;
    // Same direction; the rounding of 1e6/2 pi turns.
    EXPECT_NEAR(std::cos(Wrapped(angle)), std::cos(angle), 1e-9) << angle;
  }
}

}  // namespace
}  // namespace levitas::plant
