#include "plant_sim/magnet/magnet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"

namespace levitas::magnet {
namespace {

// ki = 40 N/A at 1 A and 0.381 mm.
constexpr Magnet kMagnet{40.0 * 0.381e-3 * 0.381e-3 / 4.0, 0.381e-3, 2.0};

TEST(MagnetForce, IsTheDifferenceOfTheTwoCoils) {
  Random random(20261121);
  for (int i = 0; i < 1000; ++i) {
    const double bias_a = random.Uniform();
    const double control_a = bias_a * (2.0 * random.Uniform() - 1.0);
    const double x_m = 0.2e-3 * (2.0 * random.Uniform() - 1.0);
    const double towards = (bias_a + control_a) / (kMagnet.gap_m - x_m);
    const double away = (bias_a - control_a) / (kMagnet.gap_m + x_m);
    const double expected = kMagnet.force_constant_n_m2_per_a2 * (towards * towards - away * away);
    // Two orders of the same arithmetic: rounding only, on forces up to some hundred newtons.
    EXPECT_NEAR(Force(kMagnet, bias_a, control_a, x_m), expected, 1e-10);
  }
}

TEST(MagnetForce, HasTheSlopesOfTheLinearForm) {
  for (const double bias_a : {0.25, 1.0}) {
    const double di = 1e-4;
    const double dx = 1e-8;
    const double per_current =
        (Force(kMagnet, bias_a, di, 0.0) - Force(kMagnet, bias_a, -di, 0.0)) / (2.0 * di);
    const double per_metre =
        (Force(kMagnet, bias_a, 0.0, dx) - Force(kMagnet, bias_a, 0.0, -dx)) / (2.0 * dx);
    // Central difference: relative error (dx/s0)^2 = 7e-10 and exact in the current.
    EXPECT_NEAR(per_current / ForcePerCurrent(kMagnet, bias_a), 1.0, 1e-8);
    EXPECT_NEAR(per_metre / NegativeStiffness(kMagnet, bias_a), 1.0, 1e-8);
  }
}

TEST(MagnetForce, PullsTowardsTheNearerCoilSoThatItDestabilises) {
  EXPECT_GT(Force(kMagnet, 1.0, 0.0, 1e-6), 0.0);
  EXPECT_LT(Force(kMagnet, 1.0, 0.0, -1e-6), 0.0);
}

TEST(MagnetForce, IsOddInCurrentAndDisplacementTogether) {
  EXPECT_EQ(Force(kMagnet, 1.0, 0.3, 2e-5), -Force(kMagnet, 1.0, -0.3, -2e-5));
}

TEST(MagnetForce, NeverUsesACoilCurrentBelowZeroOrAboveTheMaximum) {
  // One coil alone: more control current than bias changes only the other coil.
  EXPECT_EQ(Force(kMagnet, 0.5, 1.5, 0.0),
            kMagnet.force_constant_n_m2_per_a2 * 4.0 / (kMagnet.gap_m * kMagnet.gap_m));
  EXPECT_EQ(Force(kMagnet, 1.0, 7.0, 0.0), Force(kMagnet, 1.0, 1.0, 0.0));
  EXPECT_EQ(Force(kMagnet, 0.0, 0.0, 1e-4), 0.0);
}

TEST(LawOfPoles, GivesThePublishedBenchItsForcePerCurrentAndTheStiffnessOfItsPolesAtAnAngle) {
  // doi 10.14393/ufu.di.2015.186: 138 turns, 470.3 mm2, 1 A, 0.432 mm, half pole angle 0.392 rad.
  const AxisLaw law = LawOfPoles(138.0, 470.3e-6, 0.392, 0.432e-3);
  const Magnet bench{law.force_constant_n_m2_per_a2, law.gap_m, 2.0};
  EXPECT_NEAR(ForcePerCurrent(bench, 1.0) / 55.73, 1.0, 2e-4);  // printed with four digits
  // Printed with four digits, but for a gap that closes by all of x instead of x cos(0.392).
  EXPECT_NEAR(NegativeStiffness(bench, 1.0) / (1.290e5 * std::cos(0.392)), 1.0, 5e-4);
}

}  // namespace
}  // namespace levitas::magnet
