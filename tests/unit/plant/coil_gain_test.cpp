// A gain of the current in the force law, and the limits of the coils.
#include <gtest/gtest.h>

#include "plant_sim/plant/applied_effects/effect_forces.hpp"

namespace levitas::plant {
namespace {

constexpr double kKi = 4.0 * 2e-6 / (0.4e-3 * 0.4e-3);  // 4 k i0/s0^2 with i0 = 1 A: 50 N/A

double Force(double gain, double control_a, double x_m) {
  BearingModel bearing;
  bearing.magnet = {2e-6, 0.4e-3, 2.0};
  BearingEffects effects;
  effects.axis[0].gain = gain;
  const Currents currents{{control_a}, {1.0, 1.0}};
  return MagnetWithEffects(bearing, effects, currents, 0, x_m, 0.0).x_n;
}

// A few operations on numbers of some 50 N.
constexpr double kRounding_n = 1e-12;

TEST(CurrentGain, ScalesTheForceUpToTheLimitsOfTheCurrentsCarried) {
  // The coils carry 1.9 and 0.1 A of 2 A: nothing saturates, and the force is 1.2 times ki ic.
  EXPECT_NEAR(Force(1.2, 0.9, 0.0), 1.2 * kKi * 0.9, kRounding_n);
  EXPECT_NEAR(Force(1.2, -0.9, 0.0), -1.2 * kKi * 0.9, kRounding_n);
  EXPECT_NEAR(Force(0.8, 0.9, 0.0), 0.8 * kKi * 0.9, kRounding_n);
}

TEST(CurrentGain, StopsWhereTheCoilsDo) {
  EXPECT_NEAR(Force(1.2, 1.0, 0.0), 1.2 * kKi, kRounding_n);
  EXPECT_NEAR(Force(0.5, 1.5, 0.0), 0.5 * kKi, kRounding_n);  // not more than a coil can carry
}

TEST(CurrentGain, LeavesTheForceOfTheBiasAlone) {
  EXPECT_EQ(Force(1.2, 0.0, 1e-5), Force(1.0, 0.0, 1e-5));
}

}  // namespace
}  // namespace levitas::plant
