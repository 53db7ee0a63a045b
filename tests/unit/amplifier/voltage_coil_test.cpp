// A coil on a voltage against its equation in closed form.
#include "plant_sim/amplifier/voltage_coil.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace levitas::amplifier {
namespace {

constexpr VoltageCoil kCoil{1.0, 0.02, 31e-3, 4.5e-3, 0.0};
constexpr double kRounding = 1e-14;

TEST(VoltageCoil, FollowsItsOwnInductanceExponentially) {
  const double gap_m = 10e-3;
  const double tau_s = 31e-3 * std::exp(-10.0 / 4.5);
  EXPECT_NEAR(TimeConstant(kCoil, gap_m), tau_s, kRounding);
  const double expected_a = 1.02 + (0.4 - 1.02) * std::exp(-1e-3 / tau_s);
  EXPECT_NEAR(Follow(kCoil, 0.4, 1.0, true, gap_m, 0.0, 1e-3), expected_a, kRounding);
}

TEST(VoltageCoil, IsSlowerWithTheBallCloser) {
  EXPECT_LT(Follow(kCoil, 0.0, 1.0, true, 5e-3, 0.0, 1e-3),
            Follow(kCoil, 0.0, 1.0, true, 15e-3, 0.0, 1e-3));
}

TEST(VoltageCoil, EndsAtGainTimesCommandPlusOffset) {
  VoltageCoil coil = kCoil;
  coil.steady = 0.9;
  EXPECT_NEAR(Follow(coil, 3.0, 1.0, true, 10e-3, 0.0, 10.0), 0.92, kRounding);
}

TEST(VoltageCoil, InTwoHalfStepsIsTheSameAsInOne) {
  const double half_a = Follow(kCoil, 0.3, 1.5, true, 8e-3, 0.0, 5e-4);
  EXPECT_NEAR(Follow(kCoil, half_a, 1.5, true, 8e-3, 0.0, 5e-4),
              Follow(kCoil, 0.3, 1.5, true, 8e-3, 0.0, 1e-3), kRounding);
}

TEST(VoltageCoil, SwitchedOffFallsToNothingAndNeverBelow) {
  EXPECT_NEAR(Follow(kCoil, 1.0, 1.0, false, 10e-3, 0.0, 10.0), 0.0, kRounding);
  VoltageCoil coil = kCoil;
  coil.offset_a = -0.5;
  EXPECT_EQ(Follow(coil, 0.0, 0.0, true, 10e-3, 0.0, 1.0), 0.0);
}

// d(L i)/dt with L ~ e^(-gap/d): without drive and with tau long against the step, L i stays, so a
// gap that closes by v h lets the current fall by e^(-v h/d).
TEST(VoltageCoil, KeepsItsFluxWhenTheBallMovesAndTheEmfCounts) {
  const VoltageCoil ideal{1.0, 0.0, 1e12, 4.5e-3, 1.0};
  const double closing_m_per_s = -0.2;
  EXPECT_NEAR(Follow(ideal, 1.0, 0.0, true, 0.0, closing_m_per_s, 1e-3),
              std::exp(-0.2 * 1e-3 / 4.5e-3), 1e-9);  // tau is long, not infinite
}

}  // namespace
}  // namespace levitas::amplifier
