// A torque from outside on a torsional inertia: what statics says that it does to the shafts.

#include <gtest/gtest.h>

#include "tests/loop/gears/gear_motion.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/geared_rigs.hpp"

namespace levitas::test {
namespace {

constexpr double kTorqueNM = 1.5;
constexpr std::size_t kBrake = 3;  // motor, pinion, gear, brake

/// Deflection of a disc per newton in its plane: the inverse of its 2 x 2 stiffness.
double Compliance(const rotor::LumpedShaft& shaft) {
  return shaft.kaa_n_m / (shaft.kll_n_per_m * shaft.kaa_n_m - shaft.kla_n * shaft.kla_n);
}

class OutsideTorque : public testing::Test {
 protected:
  OutsideTorque() : plant(rig, 1) {}

  /// Where both shafts stand after `seconds`.
  Whirl After(double seconds) {
    const auto periods = static_cast<int>(seconds / (1e-9 * static_cast<double>(rig.period_ns)));
    for (int n = 0; n < periods; ++n) plant.Advance(Passive(0.0));
    return At(plant);
  }

  plant::PlantConfig rig{GearedRotor12()};
  plant::Plant plant;
};

TEST_F(OutsideTorque, OnTheBrakePushesBothShaftsApartAlongTheLineOfActionAndGoesAgain) {
  plant.AllowTorques();
  ASSERT_EQ(plant.model().train().inertias.at(kBrake).name, "brake");
  const Whirl before = After(4.0);
  ASSERT_TRUE(plant.SetTorque(kBrake, kTorqueNM));
  const Whirl loaded = After(4.0);
  const gear::GearPair& mesh = rig.gears[0];
  const gear::Vector n = gear::LineOfAction(mesh.pressure_angle_rad);
  const Complex force_n = kTorqueNM / mesh.driven.base_radius_m * Complex(n.x, n.y);
  const Complex pinion_m = -force_n * Compliance(rig.shafts[0].lumped);
  const Complex gear_m = force_n * Compliance(rig.shafts[1].lumped);
  EXPECT_LT(std::abs(loaded.pinion - before.pinion - pinion_m), 1e-3 * std::abs(pinion_m));
  EXPECT_LT(std::abs(loaded.gear - before.gear - gear_m), 1e-3 * std::abs(gear_m));
  ASSERT_TRUE(plant.SetTorque(kBrake, 0.0));
  const Whirl again = After(4.0);
  EXPECT_LT(std::abs(again.pinion - before.pinion), 1e-3 * std::abs(pinion_m));
}

TEST_F(OutsideTorque, LeavesAPlantWithoutOneAsItIsBitForBit) {
  plant::Plant untouched(rig, 1);
  plant.AllowTorques();
  for (int n = 0; n < 2000; ++n) {
    plant.Advance(Passive(50.0));
    untouched.Advance(Passive(50.0));
  }
  EXPECT_TRUE(std::equal(plant.state().begin(), plant.state().end(), untouched.state().begin(),
                         untouched.state().end()));
}

TEST_F(OutsideTorque, ACopyHasItsOwn) {
  plant.AllowTorques();
  (void)After(1.0);
  plant::Plant other = plant;
  ASSERT_TRUE(other.SetTorque(kBrake, kTorqueNM));
  const Whirl still = After(0.1);
  for (int n = 0; n < 1000; ++n) other.Advance(Passive(0.0));
  EXPECT_GT(std::abs(At(other).pinion - still.pinion), 1e-7);
}

TEST_F(OutsideTorque, IsRefusedWhereThereIsNoneToAct) {
  EXPECT_FALSE(plant.SetTorque(kBrake, 1.0));  // not allowed yet
  plant.AllowTorques();
  EXPECT_FALSE(plant.SetTorque(4, 1.0));
  EXPECT_FALSE(plant.SetTorque(kBrake, std::nan("")));
  const AllocationGuard guard;
  EXPECT_TRUE(plant.SetTorque(kBrake, 1.0));
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace levitas::test
