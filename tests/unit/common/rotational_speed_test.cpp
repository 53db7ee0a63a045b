// Revolutions per minute and radians per second: closed form, both ways.

#include "common/rotational_speed.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace levitas {
namespace {

TEST(RotationalSpeed, OfSixtyRpmIsOneTurnPerSecond) {
  EXPECT_DOUBLE_EQ(RpmToRadPerS(60.0), 2.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(RadPerSToRpm(2.0 * std::numbers::pi), 60.0);
}

TEST(RotationalSpeed, ComesBackWithinTwoUnitsInTheLastPlace) {
  // Four roundings of half a unit each.
  for (int rpm = 1; rpm <= 100'000; rpm += 7) {
    EXPECT_NEAR(RadPerSToRpm(RpmToRadPerS(rpm)), rpm, 2.0 * 2.3e-16 * rpm);
  }
}

TEST(RotationalSpeed, KeepsTheDirection) {
  EXPECT_EQ(RpmToRadPerS(-3000.0), -RpmToRadPerS(3000.0));
  EXPECT_EQ(RadPerSToRpm(-100.0), -RadPerSToRpm(100.0));
}

}  // namespace
}  // namespace levitas
