// The models with 4, 8 and 12 degrees of freedom against each other, and a published pair.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>

#include "numerics/dense/eigenvalues.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/rotor/lumped_shaft.hpp"
#include "tests/loop/gears/gear_motion.hpp"
#include "tests/support/geared_rigs.hpp"

namespace levitas::test {
namespace {

constexpr double kModelSpeed_rad_per_s = 2.0 * std::numbers::pi * 20.0;

// Largest difference of both shafts over a quarter of a second, over the largest displacement.
double Difference(const plant::PlantConfig& a, const plant::PlantConfig& b) {
  plant::Plant first(a, 1);
  plant::Plant second(b, 1);
  first.SetSpeed(kModelSpeed_rad_per_s, 0.0);
  second.SetSpeed(kModelSpeed_rad_per_s, 0.0);
  double difference = 0.0;
  double peak = 0.0;
  for (int n = 0; n < 2500; ++n) {
    first.Advance(Passive(kModelSpeed_rad_per_s));
    second.Advance(Passive(kModelSpeed_rad_per_s));
    const Whirl p = At(first);
    const Whirl q = At(second);
    difference = std::max({difference, std::abs(p.pinion - q.pinion), std::abs(p.gear - q.gear)});
    peak = std::max({peak, std::abs(p.pinion), std::abs(p.gear)});
  }
  return difference / peak;
}

TEST(TiltingDisc, OnItsBeamIsAsStiffAsTheUntiltedModelOnceCondensed) {
  // The published flexibilities give back 2.0e5 and 2.4e5 N/m exactly; 1e-12 is rounding.
  const auto config = GearedRotor8();
  EXPECT_NEAR(rotor::CondenseTilt(config.shafts[0].lumped).kll_n_per_m, 2.0e5, 1e-6);
  EXPECT_NEAR(rotor::CondenseTilt(config.shafts[1].lumped).kll_n_per_m, 2.4e5, 1e-6);
}

TEST(EightDegrees, WithoutGyroscopicEffectAndWithTiltCondensedAreFour) {
  auto eight = GearedRotor8();
  for (auto& shaft : eight.shafts) {
    shaft.lumped.diametral_inertia_kg_m2 = shaft.lumped.polar_inertia_kg_m2 = 0.0;
    shaft.lumped = rotor::CondenseTilt(shaft.lumped);
  }
  EXPECT_LT(Difference(eight, GearedRotor4()), 1e-12);  // the same numbers up to rounding
}

TEST(EightDegrees, ApproachFourAsTheTiltLosesItsInertia) {
  // Not condensed by formula: the tilt stays, a mode that follows at once. Its inertia of 1e-9
  // kg m2 adds 4e-9 of the disc's mass; the time step of the stiff mode leaves less than 1e-4.
  auto eight = GearedRotor8();
  for (auto& shaft : eight.shafts) {
    shaft.lumped.diametral_inertia_kg_m2 = 1e-9;
    shaft.lumped.polar_inertia_kg_m2 = 0.0;
  }
  EXPECT_LT(Difference(eight, GearedRotor4()), 1e-4);
}

TEST(EightDegrees, DifferFromFourThroughTheTiltOfTheDiscs) {
  EXPECT_GT(Difference(GearedRotor8(), GearedRotor4()), 0.001);
}

TEST(EightDegrees, FeelTheGyroscopicEffect) {
  auto without = GearedRotor8();
  for (auto& shaft : without.shafts) shaft.lumped.polar_inertia_kg_m2 = 0.0;
  EXPECT_GT(Difference(GearedRotor8(), without), 1e-5);
}

TEST(TwelveDegrees, WithRigidTorsionAreEight) {
  for (const auto direction : {gear::Direction::kIsotropic, gear::Direction::kLineOfAction}) {
    auto eight = GearedRotor8();
    auto twelve = GearedRotor12();
    eight.gears[0].direction = twelve.gears[0].direction = direction;
    for (auto& shaft : twelve.shafts) {
      // Nothing turns what is a billion times as heavy: the angle moves by 1e-9 of the
      // displacement.
      for (auto& inertia : shaft.torsion.inertias) inertia.inertia_kg_m2 *= 1e9;
    }
    EXPECT_LT(Difference(eight, twelve), 1e-6);
    EXPECT_GT(Difference(eight, GearedRotor12()), 1e-3);  // real torsion does show
  }
}

// Damped natural frequencies [rad/s] of the rig without magnets, ascending.
std::vector<double> DampedFrequencies(const plant::PlantConfig& config, double speed_rad_per_s) {
  const plant::PlantModel model(config);
  const auto size = static_cast<Eigen::Index>(2 * model.coordinates());
  const Eigen::MatrixXd a = plant::Linearise(model, speed_rad_per_s).a.topLeftCorner(size, size);
  std::vector<double> found;
  for (const std::complex<double>& value : a.eigenvalues()) {
    if (value.imag() > 1.0) found.push_back(value.imag());
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(RaoPair, HasThePublishedDampedFrequenciesAtBothSpeeds) {
  // Rao, Shiau & Chang (1998), Mech. Mach. Theory 33(6) 761: six frequencies at rest and at
  // 314.16 rad/s of the first shaft.
  const std::array<double, 6> at_rest{73.615, 76.699, 112.051, 112.757, 150.524, 236.889};
  const std::array<double, 6> spinning{72.14, 78.214, 104.28, 119.193, 150.497, 236.319};
  const auto config = RaoPair();
  for (const bool turns : {false, true}) {
    const auto found = DampedFrequencies(config, turns ? 314.16 : 0.0);
    ASSERT_GE(found.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
      const double published = (turns ? spinning : at_rest)[i];
      EXPECT_NEAR(found[i], published, 0.005 * published) << turns << " " << i;
    }
  }
}

}  // namespace
}  // namespace levitas::test
