// The rotor and its touchdown bearings: bouncing, falling, lying, lifting off.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

PlantCommand Off() {
  PlantCommand command;
  command.amplifiers_enabled = false;
  return command;
}

double Radius(const Plant& plant, std::size_t bearing) {
  const auto p = plant.ActuatorPosition();
  return std::hypot(p[2 * bearing], p[2 * bearing + 1]);
}

PlantConfig Bouncing(double damping_n_s_per_m) {
  auto config = test::RigidRotor(2.0);
  config.substeps = 32;
  for (auto& b : config.bearings) {
    b.touchdown = {190e-6, 1e6, damping_n_s_per_m, 0.0, 0.02};
  }
  return config;
}

struct Bounce {
  double largest_force_n;
  double returning_m_per_s;
};

// Thrown along x at 0.05 m/s against both bearings, until it is back in the centre.
Bounce Throw(const PlantConfig& config) {
  Plant plant(config, 1);
  plant.RestInTouchdown();
  const auto& rigid = plant.model().rigid();
  for (std::size_t i = 0; i < 2; ++i) {
    plant.mutable_state()[plant.layout().v_x + i] = 0.05 * rigid(static_cast<Eigen::Index>(i), 0);
  }
  Bounce bounce{0.0, 0.0};
  double last_m = 0.0;
  for (int i = 0; i < 200; ++i) {
    plant.Advance(Off());
    bounce.largest_force_n = std::max(bounce.largest_force_n, plant.ContactForce());
    const double now_m = plant.ActuatorPosition()[0];
    bounce.returning_m_per_s = (now_m - last_m) / 1e-4;
    last_m = now_m;
    if (i > 60 && now_m < 50e-6) break;
  }
  return bounce;
}

TEST(Contact, ThrowsTheRotorBackAsASpringDoes) {
  // m v'' = -2 k delta: deepest v sqrt(m/2k), force per bearing k times that, same speed back.
  const Bounce bounce = Throw(Bouncing(0.0));
  const double deepest_m = 0.05 * std::sqrt(2.0 / 2e6);
  // The instant of contact falls inside a substep of 3 us: w h = 3e-3 of the motion.
  EXPECT_NEAR(bounce.largest_force_n / (1e6 * deepest_m), 1.0, 0.005);
  EXPECT_NEAR(bounce.returning_m_per_s, -0.05, 0.05 * 0.005);
}

TEST(Contact, DampedGivesBackLess) {
  const Bounce bounce = Throw(Bouncing(500.0));
  EXPECT_LT(bounce.returning_m_per_s, 0.0);
  // z = d/(2 sqrt(k m)) with two bearings: 1000/(2 sqrt(2e6 x 2)) = 0.25; a damper that may not
  // pull gives back more than e^{-z pi/sqrt(1-z^2)} = 0.44, less than 1.
  EXPECT_GT(bounce.returning_m_per_s, -0.05 * 0.7);
  EXPECT_LT(bounce.returning_m_per_s, -0.05 * 0.44);
}

TEST(FailedLevitationPair, RotorFallsOutOfTheRigWithoutTouchdownBearings) {
  auto config = test::FlexibleRotor();
  for (auto& b : config.bearings) b.touchdown.stiffness_n_per_m = 0.0;
  Plant plant(config, 1);
  for (int i = 0; i < 300; ++i) plant.Advance(Off());
  EXPECT_GT(Radius(plant, 0), 0.3e-3);
}

TEST(FailedLevitationPair, RotorLandsInItsTouchdownBearingsAndComesToRest) {
  Plant plant(test::FlexibleRotor(), 1);
  plant.PlaceAtRest({});
  double deepest_m = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    plant.Advance(Off());
    deepest_m = std::max({deepest_m, Radius(plant, 0), Radius(plant, 1)});
  }
  EXPECT_LT(deepest_m, 250e-6);
  Plant lying(test::FlexibleRotor(), 1);
  lying.RestInTouchdown();
  for (std::size_t a = 0; a < 4; ++a) {
    // After 2 s of ringing at 0.3 % damping what is left is far below a tenth of a micrometre.
    EXPECT_NEAR(plant.ActuatorPosition()[a], lying.ActuatorPosition()[a], 1e-7) << a;
  }
}

TEST(RestInTouchdown, IsAnEquilibriumThatCarriesTheWeight) {
  Plant plant(test::FlexibleRotor(), 1);
  plant.RestInTouchdown();
  const AxisArray before_m = plant.ActuatorPosition();
  // Moments about the NDE bearing share the weight of 2.333 kg; the larger part lies at NDE.
  EXPECT_NEAR(before_m[0] / before_m[1], 1.0, 1e-9);  // 45 degrees
  EXPECT_LT(before_m[0], 0.0);
  for (int i = 0; i < 1000; ++i) plant.Advance(Off());
  for (std::size_t a = 0; a < 4; ++a) {
    EXPECT_NEAR(plant.ActuatorPosition()[a], before_m[a], 1e-12) << a;  // rounding on 2e-4
  }
  const double weight_n = 9.81 * plant.model().parameters().modes.total_mass_kg;
  EXPECT_GT(plant.ContactForce(), weight_n / 2.0);
  EXPECT_LT(plant.ContactForce(), weight_n);
  double sum_n = 0.0;
  for (std::size_t b = 0; b < 2; ++b) sum_n += 2e7 * (Radius(plant, b) - 190e-6);
  EXPECT_NEAR(sum_n / weight_n, 1.0, 1e-6);  // difference of 190 um and 0.5 um
}

TEST(RestInTouchdown, HoldsDownTheLighterEndOfAnOverhungRotor) {
  auto config = test::RigidRotor(2.0);
  // Both bearings left of the centre of mass at 0.1 m: the left one has to hold the shaft down.
  config.bearings[0].actuator_z_m = config.bearings[0].sensor_z_m = 0.02;
  config.bearings[1].actuator_z_m = config.bearings[1].sensor_z_m = 0.06;
  config.gravity_m_per_s2 = 9.81;
  config.gravity_direction_rad = std::numbers::pi / 2.0;
  for (auto& b : config.bearings) b.touchdown = {190e-6, 1e7, 100.0, 0.1, 0.02};
  Plant plant(config, 1);
  plant.RestInTouchdown();
  const AxisArray before_m = plant.ActuatorPosition();
  EXPECT_LT(before_m[1], -190e-6);  // y of the left bearing: pressed against the top
  EXPECT_GT(before_m[3], 190e-6);
  for (int i = 0; i < 1000; ++i) plant.Advance(Off());
  EXPECT_NEAR(plant.ActuatorPosition()[1], before_m[1], 1e-12);
  EXPECT_NEAR(plant.ActuatorPosition()[3], before_m[3], 1e-12);
}

TEST(Contact, StartsBackwardMotionOfARotatingJournal) {
  // Lying still in the bearing, then turning: friction carries the journal up the wall against
  // the rotation; without friction it stays.
  for (const double friction : {0.0, 0.2}) {
    auto config = test::FlexibleRotor();
    config.unbalance.clear();
    for (auto& b : config.bearings) b.touchdown.friction = friction;
    Plant plant(config, 1);
    plant.RestInTouchdown();
    plant.SetSpeed(50.0, 0.0);
    const auto before_m = plant.ActuatorPosition();
    PlantCommand command = Off();
    command.drive_enabled = true;
    command.speed_set_point_rad_per_s = 50.0;
    for (int i = 0; i < 200; ++i) plant.Advance(command);
    const auto after_m = plant.ActuatorPosition();
    // Angle turned about the bearing's centre: cross product, negative is backward.
    const double turned = before_m[0] * after_m[1] - before_m[1] * after_m[0];
    if (friction == 0.0) {
      EXPECT_NEAR(turned / (190e-6 * 190e-6), 0.0, 1e-6);
    } else {
      EXPECT_LT(turned / (190e-6 * 190e-6), -0.01);
    }
  }
}

TEST(Magnets, LiftTheRotorOutOfItsTouchdownBearing) {
  Plant plant(test::FlexibleRotor(), 1);
  plant.RestInTouchdown();
  // 134 um from the centre on each axis the far coil gives k (2 A/515 um)^2 = 21.9 N against 8.1 N
  // of weight: 12 m/s^2, some 50 um in 3 ms.
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.control_current_a = {1.0, 1.0, 1.0, 1.0};
  for (int i = 0; i < 30; ++i) plant.Advance(command);
  EXPECT_LT(Radius(plant, 0), 180e-6);
  EXPECT_LT(Radius(plant, 1), 180e-6);
  EXPECT_EQ(plant.ContactForce(), 0.0);
}

}  // namespace
}  // namespace levitas::plant
