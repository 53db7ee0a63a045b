// Discs on massless shafts, whose modes are closed forms.

#include "analysis/damped_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/geared_rigs.hpp"

namespace levitas::analysis {
namespace {

// Beyond the rounding of the eigenvalues of a few rows (1e-11), far below any mistake.
constexpr double kOfRounding = 1e-8;
constexpr double kDiscKg = 2.0;
constexpr double kDiscNPerM = 2e5;

/// One disc that moves sideways on its shaft, and the magnet of the pinion beside it.
plant::PlantConfig OneDisc() {
  plant::PlantConfig rig = test::GearedRotor4();
  rig.shafts.resize(1);
  rig.gears.clear();
  rig.bearings.resize(1);
  rig.shafts[0].lumped.mass_kg = kDiscKg;
  rig.shafts[0].lumped.kll_n_per_m = kDiscNPerM;
  rig.shafts[0].lumped.damping_n_s_per_m = 0.0;
  return rig;
}

double Hertz(double rad_per_s) { return rad_per_s / (2.0 * std::numbers::pi); }

void ExpectFrequency(const DampedMode& mode, double rad_per_s) {
  EXPECT_NEAR(mode.frequency_hz, Hertz(rad_per_s), kOfRounding * Hertz(rad_per_s));
}

// m s^2 + c s + k = 0: s = -d w +- j w sqrt(1 - d^2), w = sqrt(k/m), d = c/(2 sqrt(k m)). With its
// current the magnet would soften the shaft by ks = 1e5 N/m, half of its stiffness.
TEST(DampedModes, OfADiscAreThoseOfItsOwnShaftWithoutTheMagnet) {
  plant::PlantConfig rig = OneDisc();
  rig.shafts[0].lumped.damping_n_s_per_m = 200.0;
  const auto modes = DampedModes(rig, 0.0).modes;
  ASSERT_EQ(modes.size(), 2U) << "one in each plane";
  const double natural = std::sqrt(kDiscNPerM / kDiscKg);
  const double ratio = 200.0 / (2.0 * std::sqrt(kDiscNPerM * kDiscKg));
  for (const DampedMode& mode : modes) {
    ExpectFrequency(mode, natural * std::sqrt(1.0 - ratio * ratio));
    EXPECT_NEAR(mode.damping_ratio, ratio, kOfRounding);
    EXPECT_EQ(mode.torsion_share, 0.0);
  }
}

// Tilt psi e^(j w t): Id w^2 - Ip W w - k = 0, a slow backward and a fast forward whirl.
TEST(DampedModes, OfATurningDiscWhirlForwardFasterThanBackward) {
  plant::PlantConfig rig = OneDisc();
  constexpr double kDiametral = 2e-3, kPolar = 3e-3, kTilt_n_m = 50.0, kSpeed = 300.0;
  rotor::LumpedShaft& disc = rig.shafts[0].lumped;
  disc.tilts = true;
  disc.kla_n = 0.0;
  disc.kaa_n_m = kTilt_n_m;
  disc.diametral_inertia_kg_m2 = kDiametral;
  disc.polar_inertia_kg_m2 = kPolar;
  const DampedModesAtSpeed at = DampedModes(rig, kSpeed);
  EXPECT_EQ(at.speed_rad_per_s, kSpeed);
  ASSERT_EQ(at.modes.size(), 4U);                            // 50, 316 twice and 500 rad/s
  const double half = kPolar * kSpeed / (2.0 * kDiametral);  // 225 rad/s
  const double root = std::sqrt(half * half + kTilt_n_m / kDiametral);  // 275 rad/s
  ExpectFrequency(at.modes[0], root - half);
  EXPECT_NEAR(at.modes[0].forward_share, 0.0, kOfRounding);
  ExpectFrequency(at.modes[1], std::sqrt(kDiscNPerM / kDiscKg));
  ExpectFrequency(at.modes[2], std::sqrt(kDiscNPerM / kDiscKg));
  ExpectFrequency(at.modes[3], root + half);
  EXPECT_NEAR(at.modes[3].forward_share, 1.0, kOfRounding);
}

// Two inertias on a spring, free to turn together: w^2 = k (1/J1 + 1/J2).
TEST(DampedModes, OfAFreeTorsionLineAreOneOfTorsionAloneWithItsDamping) {
  plant::PlantConfig rig = OneDisc();
  constexpr double kNear = 5e-3, kFar = 3e-3, kSpring = 1.8e3, kDamping = 0.01;
  rig.shafts[0].torsion = {rotor::TorsionKind::kInertias,
                           {{"motor", kNear, kSpring, 0.0, 0.0}, {"disc", kFar, 0.0, 0.0, 0.0}},
                           1,
                           kDamping,
                           {}};
  const auto modes = DampedModes(rig, 0.0).modes;
  ASSERT_EQ(modes.size(), 3U) << "the turning as a whole is no vibration";
  const double natural = std::sqrt(kSpring * (1.0 / kNear + 1.0 / kFar));  // 980 rad/s
  ExpectFrequency(modes[2], natural * std::sqrt(1.0 - kDamping * kDamping));
  EXPECT_NEAR(modes[2].damping_ratio, kDamping, kOfRounding);
  EXPECT_NEAR(modes[2].torsion_share, 1.0, kOfRounding);
  EXPECT_NEAR(modes[0].torsion_share, 0.0, kOfRounding);
  EXPECT_NEAR(modes[1].torsion_share, 0.0, kOfRounding);
}

}  // namespace
}  // namespace levitas::analysis
