// What geared shafts put on the housing and bear as torque, against statics.

#include "plant_sim/plant/shaft_loads.hpp"

#include <gtest/gtest.h>

#include "plant_sim/plant/modal_sum.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/loop/gears/gear_motion.hpp"
#include "tests/support/geared_rigs.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::test {
namespace {

struct Loads {
  std::vector<gear::Vector> housing_n;
  std::vector<double> torque_n_m;
};

class ShaftLoadsAtRest : public testing::Test {
 protected:
  Loads After(double seconds, const plant::PlantCommand& command) {
    const auto periods = static_cast<int>(seconds / (1e-9 * static_cast<double>(rig.period_ns)));
    for (int n = 0; n < periods; ++n) plant.Advance(command);
    const plant::ShaftLoads loads(plant.model());
    return {loads.Housing(plant), loads.Torques(plant)};
  }

  static plant::PlantConfig Wired() {
    plant::PlantConfig rig = GearedRotor12();
    rig.actuator_polarity.fill(1.0);
    return rig;
  }

  plant::PlantConfig rig{Wired()};
  plant::Plant plant{rig, 1};
};

// At rest the housing holds what the teeth push, and the springs bear what the brake asks for.
TEST_F(ShaftLoadsAtRest, OfABrakesTorqueAreTheTeethsForceAndThatTorque) {
  constexpr double kLoadNM = 1.5;
  constexpr std::size_t kLoaded = 3;  // motor, pinion, gear, brake
  plant.AllowTorques();
  const Loads before = After(4.0, Passive(0.0));
  ASSERT_TRUE(plant.SetTorque(kLoaded, kLoadNM));
  const Loads loaded = After(4.0, Passive(0.0));
  const gear::GearPair& mesh = rig.gears[0];
  const gear::Vector n = gear::LineOfAction(mesh.pressure_angle_rad);
  const double force_n = kLoadNM / mesh.driven.base_radius_m;
  const double signs[] = {-1.0, 1.0};
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_NEAR(loaded.housing_n[s].x - before.housing_n[s].x, signs[s] * force_n * n.x,
                2e-3 * force_n);
    EXPECT_NEAR(loaded.housing_n[s].y - before.housing_n[s].y, signs[s] * force_n * n.y,
                2e-3 * force_n);
  }
  ASSERT_EQ(plant::ShaftLoads(plant.model()).twisted(),
            (std::vector<std::string>{"motor to pinion", "gear to brake"}));
  const double ratio = mesh.driving.base_radius_m / mesh.driven.base_radius_m;
  EXPECT_NEAR(std::abs(loaded.torque_n_m[0] - before.torque_n_m[0]), ratio * kLoadNM,
              2e-3 * kLoadNM);
  EXPECT_NEAR(std::abs(loaded.torque_n_m[1] - before.torque_n_m[1]), kLoadNM, 2e-3 * kLoadNM);
}

// Magnets stand on the housing: what they pull at a shaft at rest, they and its springs hold
// between them, and both shafts together weigh on the housing no more than before.
TEST_F(ShaftLoadsAtRest, OfAMagnetsPullAreNothingTogether) {
  const Loads before = After(8.0, Passive(0.0));
  plant::PlantCommand pull = Passive(0.0);
  pull.amplifiers_enabled = true;
  pull.bias_current_a = 0.3;  // less negative stiffness than the shafts have
  pull.control_current_a[0] = 0.25;
  const Loads pulled = After(8.0, pull);
  const double force_n = plant.MagnetForce()[0];
  ASSERT_GT(force_n, 3.0);
  double x_n = 0.0;
  for (std::size_t s = 0; s < 2; ++s) x_n += pulled.housing_n[s].x - before.housing_n[s].x;
  EXPECT_NEAR(x_n, 0.0, 2e-3 * force_n);
}

TEST(ModalSum, IsOfTheRowAndOfNoMoreCoordinates) {
  const double modal[] = {3.0, -1.0, 1e9};
  EXPECT_EQ(plant::ModalSum({2.0, 4.0}, modal), 2.0);
  EXPECT_EQ(plant::ModalSum({}, modal), 0.0);
}

TEST(ShaftLoads, OfARigWithOneRotorAreNone) {
  const plant::Plant rotor(QuietFlexibleRotor(), 1);
  const plant::ShaftLoads loads(rotor.model());
  EXPECT_TRUE(loads.Housing(rotor).empty());
  EXPECT_TRUE(loads.Torques(rotor).empty());
}

}  // namespace
}  // namespace levitas::test
