// From the entries of a geared rig to its misaligned couplings: one each, with the force and the
// error of rotation that it names. What the shafts then do is in tests/loop/gears.

#include "plant_sim/plant/applied_effects/coupling_effects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/support/geared_rigs.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

using effect::EffectConfig;
using effect::Id;

constexpr double kDisc_m = 0.2;  // the plane of both discs of the rigs that tilt

EffectConfig Misaligned(double z_m, double order, double force_n, double phase_rad,
                        double rotation_rad, bool driven = false) {
  EffectConfig entry =
      test::Entry(Id::kMisalignment, {z_m, order, force_n, phase_rad, rotation_rad});
  entry.on_driven = driven;
  return entry;
}

/// A rig and the train that PrepareCouplings made of its entries.
struct Prepared {
  PlantParameters parameters;
  TrainModel train;
};

/// The entries are not checked as those of a file are, so that Prepare itself has to refuse them.
Prepared PreparedOf(const PlantConfig& healthy, const std::vector<EffectConfig>& entries) {
  const PlantModel model(healthy);
  Prepared of{model.parameters(), model.train()};
  of.parameters.config.effects = entries;
  PrepareCouplings(of.parameters, of.train);
  return of;
}

std::complex<double> Phasor(const gear::Vector& v) { return {v.x, v.y}; }

TEST(CouplingEffects, AreOnePerMisalignedCouplingInTheOrderOfTheEntries) {
  const Prepared of = PreparedOf(
      test::GearedRotor8(),
      {Misaligned(kDisc_m, 1, 2.0, 0.0, 0.0, true), test::Entry(Id::kToothCrack, {0.5, 3.0}),
       Misaligned(kDisc_m, -3, 0.0, 0.0, 1e-4), Misaligned(kDisc_m, 2, 1, 0, 0)});
  const auto& couplings = of.train.couplings;
  ASSERT_EQ(couplings.size(), 3U);
  EXPECT_EQ(couplings[0].order, 1);
  EXPECT_EQ(couplings[1].order, -3);
  EXPECT_EQ(couplings[2].order, 2);
  EXPECT_EQ(couplings[0].shaft, 1U);
  EXPECT_DOUBLE_EQ(couplings[0].ratio, -20.0 / 40.0);  // backwards, by the teeth
  EXPECT_EQ(couplings[1].shaft, 0U);
  EXPECT_DOUBLE_EQ(couplings[1].ratio, 1.0);
}

TEST(CouplingEffects, AreNoneWithoutGearsOrWithoutEntries) {
  const Prepared one_rotor = PreparedOf(test::RigidRotor(4.0), {Misaligned(0.0, 2, 3.0, 0.0, 0.0),
                                                                Misaligned(0.0, 1, 1.0, 0.0, 0.0)});
  EXPECT_TRUE(one_rotor.train.couplings.empty());
  EXPECT_TRUE(PreparedOf(test::GearedRotor8(), {}).train.couplings.empty());
  EXPECT_TRUE(PreparedOf(test::GearedRotor8(), {test::Entry(Id::kGearRunout, {3e-5, 0.5})})
                  .train.couplings.empty());
}

TEST(CouplingEffects, TakeTheStrengthOfTheirOwnEntry) {
  constexpr double kPhase = 0.7;
  constexpr double kForce_n = 3.0;
  constexpr double kError_rad = 4e-4;
  Prepared of =
      PreparedOf(test::GearedRotor8(), {Misaligned(kDisc_m, 2, kForce_n, kPhase, kError_rad),
                                        test::Entry(Id::kBacklash, {4e-5}),
                                        Misaligned(kDisc_m, 2, kForce_n, kPhase, kError_rad, true),
                                        Misaligned(kDisc_m, 2, kForce_n, kPhase, kError_rad)});
  const auto& couplings = of.train.couplings;
  ASSERT_EQ(couplings.size(), 3U);
  ApplyToCouplings(of.parameters, std::array{1.0, 0.3, 0.5, 0.0}, of.train);
  const std::array expected{1.0, 0.5, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::complex<double> turned = std::polar(expected[i], kPhase);
    EXPECT_LT(std::abs(Phasor(couplings[i].force_n) - kForce_n * turned), 1e-15) << i;
    EXPECT_LT(std::abs(Phasor(couplings[i].rotation_rad) - kError_rad * turned), 1e-18) << i;
  }
  ApplyToCouplings(of.parameters, std::array{0.0, 1.0, 0.0, 0.0}, of.train);
  for (const CouplingModel& coupling : couplings) {
    EXPECT_EQ(Phasor(coupling.force_n), 0.0);
    EXPECT_EQ(Phasor(coupling.rotation_rad), 0.0);
  }
}

// A universal joint by itself: tan(out) = tan(in)/cos(a). Two entries leave what comes six times a
// turn, t^3/3, and less.
TEST(CouplingEffects, MakeTheUnevenRotationOfAUniversalJoint) {
  constexpr double kAngle_rad = 0.25;
  const double t = std::pow(std::tan(0.5 * kAngle_rad), 2);
  const double behind = -0.5 * std::numbers::pi;  // a sine
  Prepared of = PreparedOf(
      test::GearedRotor8(),
      {Misaligned(kDisc_m, 2, 0.0, behind, t), Misaligned(kDisc_m, 4, 0.0, behind, 0.5 * t * t)});
  ApplyToCouplings(of.parameters, std::array{1.0, 1.0}, of.train);
  for (double in = -1.5; in <= 1.5; in += 0.1) {
    double error = 0.0;
    for (const CouplingModel& coupling : of.train.couplings) {
      const double turned = coupling.order * coupling.ratio * in;
      error += std::real(Phasor(coupling.rotation_rad) * std::polar(1.0, turned));
    }
    const double out = std::atan(std::tan(in) / std::cos(kAngle_rad));
    EXPECT_NEAR(error, out - in, 1.1 * t * t * t / 3.0) << in;
  }
}

TEST(CouplingEffects, WithoutTorsionMoveTheTeethByTheBaseRadiusOfTheirWheel) {
  const PlantConfig healthy = test::GearedRotor8();
  const Prepared of = PreparedOf(healthy, {Misaligned(kDisc_m, 1, 0.0, 0.0, 1e-4),
                                           Misaligned(kDisc_m, 1, 0.0, 0.0, 1e-4, true)});
  EXPECT_EQ(of.train.couplings[0].base_radius_m, healthy.gears[0].driving.base_radius_m);
  EXPECT_EQ(of.train.couplings[1].base_radius_m, healthy.gears[0].driven.base_radius_m);
  for (const CouplingModel& coupling : of.train.couplings) EXPECT_TRUE(coupling.twist.empty());
  // A beam's torsion has no spring of its own beside the wheel.
  const Prepared beams = PreparedOf(test::RaoPair(), {Misaligned(5.8, 1, 1.0, 0.0, 1e-4)});
  EXPECT_EQ(beams.train.couplings[0].base_radius_m, 0.5086);
  EXPECT_TRUE(beams.train.couplings[0].twist.empty());
}

// Held at rest by an error that stays: the drive holds the motor, so the pinion alone gives way, by
// the whole error. Theta^T k e on the modes and their own stiffness say so without the springs.
TEST(CouplingEffects, WithTorsionTwistTheSpringTowardsTheDriveByTheError) {
  const Prepared of = PreparedOf(test::GearedRotor12(), {Misaligned(kDisc_m, 2, 0.0, 0.0, 1e-4)});
  const CouplingModel& coupling = of.train.couplings[0];
  EXPECT_EQ(coupling.base_radius_m, 0.0);
  const auto& frequency = of.parameters.torsion.frequency_rad_per_s;
  ASSERT_EQ(coupling.twist.size(), static_cast<std::size_t>(frequency.size()));
  double motor = 0.0;
  double pinion = 0.0;
  for (std::size_t i = 0; i < coupling.twist.size(); ++i) {
    const double w = frequency[static_cast<Eigen::Index>(i)];
    if (coupling.twist[i] == 0.0) continue;  // of the other shaft, which turns freely
    motor += of.train.inertias[0].twist[i] * coupling.twist[i] / (w * w);
    pinion += of.train.inertias[1].twist[i] * coupling.twist[i] / (w * w);
  }
  EXPECT_NEAR(motor, 0.0, 1e-9);
  EXPECT_NEAR(pinion, 1.0, 1e-9);
}

// The driven wheel's spring leads to the brake: k on the wheel, -k on the brake, no sum.
TEST(CouplingEffects, WithTorsionTwistTheSpringOfADrivenWheelAwayFromIt) {
  const Prepared of =
      PreparedOf(test::GearedRotor12(), {Misaligned(kDisc_m, 1, 0.0, 0.0, 1e-4, true)});
  const CouplingModel& coupling = of.train.couplings[0];
  const auto& wheel = of.train.inertias[2];
  const auto& brake = of.train.inertias[3];
  ASSERT_EQ(wheel.name, "gear");
  ASSERT_EQ(brake.name, "brake");
  constexpr double kStiffness = 1.47e3;
  ASSERT_EQ(coupling.twist.size(), wheel.twist.size());
  for (std::size_t i = 0; i < coupling.twist.size(); ++i) {
    EXPECT_NEAR(coupling.twist[i], kStiffness * (wheel.twist[i] - brake.twist[i]), 1e-9) << i;
  }
}

TEST(CouplingEffects, PushThePlaneThatTheyName) {
  const Prepared of = PreparedOf(test::GearedRotor8(), {Misaligned(kDisc_m, 1, 2.0, 0.0, 0.0),
                                                        Misaligned(kDisc_m, 1, 0, 0, 1e-4)});
  // Both the disc and the wheel on it are there.
  EXPECT_EQ(of.train.couplings[0].shape, of.train.meshes[0].driving_shape);
  for (const double none : of.train.couplings[1].shape) EXPECT_EQ(none, 0.0);
}

TEST(CouplingEffects, RefuseAPlaneThatIsNoNodeOfTheirShaft) {
  const auto refusal = [](const PlantConfig& rig, const EffectConfig& entry) -> std::string {
    try {
      static_cast<void>(PreparedOf(rig, {entry}));
    } catch (const std::invalid_argument& refused) {
      return refused.what();
    }
    return "";
  };
  const std::string disc = refusal(test::GearedRotor8(), Misaligned(0.1, 1, 2.0, 0.0, 0.0));
  EXPECT_THAT(disc, testing::HasSubstr("z = 100 mm is no plane of shaft 1, which has 200 mm"));
  // 5.8 m is the end of the first shaft, but beyond the second.
  EXPECT_EQ(refusal(test::RaoPair(), Misaligned(5.8, 1, 2.0, 0.0, 0.0)), "");
  EXPECT_THAT(refusal(test::RaoPair(), Misaligned(5.8, 1, 2.0, 0.0, 0.0, true)),
              testing::HasSubstr("is no plane of shaft 2"));
  EXPECT_NE(refusal(test::GearedRotor8(), Misaligned(std::nan(""), 1, 2.0, 0.0, 0.0)), "");
  // Without a force nothing is pushed there.
  EXPECT_EQ(refusal(test::GearedRotor8(), Misaligned(0.1, 1, 0.0, 0.0, 1e-4)), "");
}

}  // namespace
}  // namespace levitas::plant
