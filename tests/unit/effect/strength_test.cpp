#include "plant_sim/effect/strength.hpp"

#include <gtest/gtest.h>

namespace levitas::effect {
namespace {

Parameter With(Scaling scaling, double neutral) {
  Parameter p;
  p.scaling = scaling;
  p.neutral = neutral;
  return p;
}

TEST(AtStrength, IsTheValueAtOneAndNeutralAtZeroBitForBit) {
  // 0.1 and 0.7 have no exact double: interpolation would change their last bit.
  EXPECT_EQ(AtStrength(With(Scaling::kLinear, 0.7), 0.1, 0.0, 1.0), 0.1);
  EXPECT_EQ(AtStrength(With(Scaling::kLinear, 0.7), 0.1, 0.0, 0.0), 0.7);
  EXPECT_EQ(AtStrength(With(Scaling::kGeometric, kOwn), 0.1, 0.7, 0.0), 0.7);
  EXPECT_EQ(AtStrength(With(Scaling::kGeometric, kOwn), 0.1, 0.7, 1.0), 0.1);
  EXPECT_EQ(AtStrength(With(Scaling::kInverse, kNever), 0.1, 0.0, 0.0), kNever);
}

TEST(AtStrength, GoesLinearlyInverselyOrGeometricallyBetween) {
  EXPECT_DOUBLE_EQ(AtStrength(With(Scaling::kLinear, 1.0), 3.0, 0.0, 0.25), 1.5);
  EXPECT_DOUBLE_EQ(AtStrength(With(Scaling::kInverse, kNever), 3.0, 0.0, 0.25), 12.0);
  EXPECT_DOUBLE_EQ(AtStrength(With(Scaling::kGeometric, kOwn), 400.0, 100.0, 0.5), 200.0);
}

TEST(AtStrength, LeavesPhasesAndOrdersAlone) {
  for (const double s : {0.0, 0.3, 1.0}) {
    EXPECT_EQ(AtStrength(With(Scaling::kFixed, 0.0), 1.2, 0.0, s), 1.2);
  }
}

TEST(StrengthAt, SetsInAtItsTimeAndGrowsLinearlyDuringTheRamp) {
  EffectConfig entry;
  entry.strength = 0.8;
  entry.at_s = 2.0;
  entry.ramp_s = 4.0;
  EXPECT_EQ(StrengthAt(entry, 1.999), 0.0);
  EXPECT_EQ(StrengthAt(entry, 2.0), 0.0);
  EXPECT_DOUBLE_EQ(StrengthAt(entry, 3.0), 0.2);
  EXPECT_EQ(StrengthAt(entry, 6.0), 0.8);
  EXPECT_EQ(StrengthAt(entry, 1e6), 0.8);
}

TEST(StrengthAt, IsSuddenWithoutARampAndFullFromTheStartWithoutATime) {
  EffectConfig entry;
  EXPECT_FALSE(entry.timed());
  EXPECT_EQ(StrengthAt(entry, 0.0), 1.0);
  entry.at_s = 2.0;
  EXPECT_TRUE(entry.timed());
  EXPECT_EQ(StrengthAt(entry, 1.999), 0.0);
  EXPECT_EQ(StrengthAt(entry, 2.0), 1.0);
}

}  // namespace
}  // namespace levitas::effect
