#include "plant_sim/effect/hysteresis.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <vector>

namespace levitas::effect {
namespace {

constexpr double kWidth_a = 0.03;

/// Area of the loop effective current over current, per turn, once it repeats.
double LoopArea(double shape, double amplitude_a, int steps) {
  double z = 0.0;
  double area = 0.0;
  double before_a = 0.0;
  double before_effective_a = 0.0;
  for (int turn = 0; turn < 4; ++turn) {
    area = 0.0;
    for (int i = 1; i <= steps; ++i) {
      const double phase = 2.0 * std::numbers::pi * i / steps;
      const double now_a = amplitude_a * std::sin(phase);
      z = HysteresisStep(kWidth_a, shape, z, before_a, now_a);
      const double effective_a = now_a - kWidth_a * z;
      area += 0.5 * (before_effective_a + effective_a) * (now_a - before_a);
      before_a = now_a;
      before_effective_a = effective_a;
    }
  }
  return std::abs(area);
}

TEST(Hysteresis, OfShapeZeroIsPlayWithTheAreaOfItsParallelogram) {
  // Play of half width w under amplitude A: area 4 w (A - w). The polygon of 4000 points misses
  // 1 - cos(pi/2000) of the corners: 1e-6 of it, and the trapezoid rule as much.
  const double amplitude_a = 0.2;
  EXPECT_NEAR(LoopArea(0.0, amplitude_a, 4000), 4.0 * kWidth_a * (amplitude_a - kWidth_a), 1e-6);
}

TEST(Hysteresis, OfShapeOneApproachesItsBranchExponentially) {
  // From a turning point at z = -1: 1 - z = 2 exp(-d/(2 w)).
  const double moved_a = 0.05;
  EXPECT_NEAR(HysteresisStep(kWidth_a, 1.0, -1.0, 0.1, 0.1 + moved_a),
              1.0 - 2.0 * std::exp(-moved_a / (2.0 * kWidth_a)), 1e-15);
  EXPECT_NEAR(HysteresisStep(kWidth_a, 1.0, 1.0, 0.1, 0.1 - moved_a),
              -1.0 + 2.0 * std::exp(-moved_a / (2.0 * kWidth_a)), 1e-15);
}

TEST(Hysteresis, DoesNotDependOnTheRateNorOnTheStepsOfAMonotonePiece) {
  std::mt19937_64 draw{20261121};
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const double shape : {0.0, 0.3, 1.0, 1.5, 2.0}) {
    for (int trial = 0; trial < 200; ++trial) {
      const double z = 2.0 * share(draw) - 1.0;
      const double from_a = share(draw) - 0.5;
      const double to_a = share(draw) - 0.5;
      const double between_a = from_a + share(draw) * (to_a - from_a);
      const double once = HysteresisStep(kWidth_a, shape, z, from_a, to_a);
      const double twice = HysteresisStep(
          kWidth_a, shape, HysteresisStep(kWidth_a, shape, z, from_a, between_a), between_a, to_a);
      // Powers with exponents up to 1/0.5: a few units in the last place, magnified near z = 1.
      EXPECT_NEAR(once, twice, 1e-9) << "shape " << shape;
    }
  }
}

TEST(Hysteresis, StaysBetweenItsBranchesAndNeverMovesAgainstTheCurrent) {
  std::mt19937_64 draw{7};
  std::normal_distribution<double> step(0.0, 0.05);
  for (const double shape : {0.0, 0.5, 1.0, 2.0}) {
    double z = 0.0;
    double current_a = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      const double next_a = current_a + step(draw);
      const double after = HysteresisStep(kWidth_a, shape, z, current_a, next_a);
      ASSERT_LE(std::abs(after), 1.0);
      // Effective current moves with the current: dz/d ic <= 1/w.
      const double moved_a = (next_a - current_a) - kWidth_a * (after - z);
      ASSERT_GE(moved_a * (next_a - current_a), -1e-15) << "shape " << shape;
      z = after;
      current_a = next_a;
    }
  }
}

TEST(Hysteresis, LosesTheSameEnergyInASlowAndAFastTurn) {
  EXPECT_NEAR(LoopArea(1.0, 0.2, 500) / LoopArea(1.0, 0.2, 5000), 1.0, 1e-3);  // polygons differ
}

TEST(Hysteresis, OfAStandingCurrentStands) {
  EXPECT_EQ(HysteresisStep(kWidth_a, 1.0, 0.4, 0.1, 0.1), 0.4);
}

}  // namespace
}  // namespace levitas::effect
