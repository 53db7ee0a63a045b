// One-step predictions of the ball.

#include "diagnosis/levitator/motion_run.hpp"

#include <gtest/gtest.h>

#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

using test::CarryingCurrent;
using test::LevitatorFile;
using test::StillSeries;

NominalRig MotionRig() { return NominalOf(LevitatorFile()); }

/// The last innovation of a ball that is held still by the current that carries it.
double Last(const Theta& theta, double x_m = 0.0) {
  const NominalRig rig = MotionRig();
  Series series = StillSeries(600, 1.0, CarryingCurrent(rig, x_m), x_m);
  for (double& lower_a : series.measured_a[1]) lower_a = 0.0;
  return Innovations(rig, series, theta, 0, {}).back();
}

constexpr double kStill_m = 1e-12;  // rounding of an acceleration of 9.81 m/s2 over 1 ms

TEST(Innovations, AreZeroForABallThatItsCurrentCarries) {
  EXPECT_NEAR(Last(Zeros(1)), 0.0, kStill_m);
  EXPECT_NEAR(Last(Zeros(1), 2e-3), 0.0, kStill_m);
}

TEST(Innovations, FallShortWhereAModelPullsTooHard) {
  Theta theta = Zeros(1);
  theta[kLoad] = 0.01;
  const double once_m = Last(theta);
  theta[kLoad] = 0.02;
  EXPECT_LT(once_m, -1e-5);  // 0.165 m/s2 against an observer of 60 rad/s: 46 um
  EXPECT_NEAR(Last(theta) / once_m, 2.0, 0.02);  // the force bends by 1 % over the way
}

TEST(Innovations, CannotTellAWeakerMagnetFromAHeavierBall) {
  Theta weaker = Zeros(1);
  weaker[kForce] = -0.1;
  Theta heavier = Zeros(1);
  heavier[kMass] = 1.0 / 0.9 - 1.0;
  EXPECT_NEAR(Last(weaker), Last(heavier), kStill_m);
  EXPECT_GT(Last(weaker), 1e-4);
}

TEST(Innovations, SeeAStifferMagnetOnlyAwayFromTheCentre) {
  Theta theta = Zeros(1);
  theta[kForceDecay] = 0.1;
  EXPECT_NEAR(Last(theta), 0.0, kStill_m);
  EXPECT_LT(Last(theta, 2e-3), -1e-5);
  EXPECT_GT(Last(theta, -2e-3), 1e-5);
}

TEST(Innovations, KeepTheirForceUnderTheUnitCurrentWhateverTheExponent) {
  // F ~ i^(2 + n): at 1 A the exponent does nothing, beyond it the force grows.
  Theta theta = Zeros(1);
  theta[kForceExponent] = 0.2;
  const double carrying_a = CarryingCurrent(MotionRig(), 0.0);
  EXPECT_GT(carrying_a, 1.0);
  EXPECT_LT(Last(theta), 0.0);
}

TEST(Innovations, UseTheModelsCurrentsWhereNoneWereMeasured) {
  const NominalRig rig = MotionRig();
  Series series = StillSeries(600, CarryingCurrent(rig, 0.0) - rig.offset_a, 0.0);
  series.measured_a = {};
  const CoilRun coils = RunCoils(rig, series, Zeros(1), 0);
  // The idle coil's 24 mA pull with 2e-5 N: 0.1 um in the observer.
  EXPECT_NEAR(Innovations(rig, series, Zeros(1), 0, coils).back(), 0.0, 2e-7);
}

TEST(Innovations, StartAnewWhereRowsAreMissing) {
  const NominalRig rig = MotionRig();
  Series series = StillSeries(200, 1.0, CarryingCurrent(rig, 0.0));
  for (std::size_t n = 100; n < 200; ++n) series.position_m[n] = 3e-3;
  const auto jumped = Innovations(rig, series, Zeros(1), 0, {});
  EXPECT_NEAR(jumped[100], 3e-3, 1e-5);
  series.restart[100] = true;
  EXPECT_EQ(Innovations(rig, series, Zeros(1), 0, {})[100], 0.0);
}

}  // namespace
}  // namespace levitas::levitator
