#include "plant_sim/effect/coil.hpp"

#include <gtest/gtest.h>

namespace levitas::effect {
namespace {

TEST(Asymmetry, MakesForceConstantsOfTheGivenRatioWithTheirSumUnchanged) {
  for (const double ratio : {0.3, 1.0, 1.2, 4.0}) {
    const CoilFactors f = Asymmetry(ratio);
    const double towards = f.towards * f.towards;  // force goes with the square of the current
    const double away = f.away * f.away;
    EXPECT_NEAR(towards / away, ratio, 1e-14 * ratio);
    EXPECT_NEAR(towards + away, 2.0, 1e-15);
  }
}

TEST(Asymmetry, OfEqualCoilsIsNone) {
  EXPECT_EQ(Asymmetry(1.0).towards, 1.0);
  EXPECT_EQ(Asymmetry(1.0).away, 1.0);
}

TEST(Saturated, IsFroelichsLawForExponentOne) {
  EXPECT_DOUBLE_EQ(Saturated(2.0, 1.0 / 3.0, 1.0), 2.0 / (1.0 + 2.0 / 3.0));
}

TEST(Saturated, HasTwoAsymptotesThatMeetAtTheKnee) {
  const double knee_a = 1.5;
  // i/(1 + (i/k)^n)^(1/n) = i (1 - (i/k)^n/n + ...) far below the knee, k above it.
  EXPECT_NEAR(Saturated(0.05 * knee_a, 1.0 / knee_a, 4.0) / (0.05 * knee_a), 1.0,
              0.05 * 0.05 * 0.05 * 0.05);
  EXPECT_NEAR(Saturated(100.0 * knee_a, 1.0 / knee_a, 4.0), knee_a, 1e-8 * knee_a);
  EXPECT_NEAR(Saturated(knee_a, 1.0 / knee_a, 4.0), knee_a / std::pow(2.0, 0.25), 1e-15);
}

TEST(Saturated, OfAnInfiniteKneeLeavesTheCurrentBitForBit) {
  EXPECT_EQ(Saturated(0.1, 0.0, 4.0), 0.1);
  EXPECT_EQ(SaturatedSlope(0.1, 0.0, 4.0), 1.0);
}

TEST(SaturatedSlope, IsTheDerivative) {
  constexpr double kStep = 1e-6;
  for (const double i : {0.1, 0.9, 1.5, 3.0}) {
    const double difference =
        (Saturated(i + kStep, 1.0 / 1.5, 4.0) - Saturated(i - kStep, 1.0 / 1.5, 4.0)) / (2 * kStep);
    // Central difference: third derivative of order 10 times h^2/6, and rounding 1e-16/h.
    EXPECT_NEAR(SaturatedSlope(i, 1.0 / 1.5, 4.0), difference, 1e-9);
  }
}

}  // namespace
}  // namespace levitas::effect
