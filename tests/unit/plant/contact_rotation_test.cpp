// What touches the stator and turns: friction by the speed and sense of its own shaft, and what it
// does to the speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant_sim/plant/drive.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/plant/time_step.hpp"
#include "tests/support/geared_rigs.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

constexpr double kGravity = 9.81;

PlantCommand Off() {
  PlantCommand command;
  command.amplifiers_enabled = false;
  return command;
}

struct Touch {
  double across_n{};
  ForceReport report;
};

// The journal of a bearing 100 um into a ring of 1e7 N/m on the +x side, at rest but for rotation.
Touch PressedAgainstTheRing(std::size_t bearing, double speed_rad_per_s) {
  PlantConfig config = test::GearedRotor4();
  config.bearings[bearing].touchdown = {300e-6, 1e7, 0.0, 0.1, 0.02};
  const PlantModel model(config);
  const std::size_t modes = model.layout().modes;
  std::vector<double> position(model.coordinates(), 0.0);
  for (std::size_t i = 0; i < modes; ++i) {
    position[i] = 400e-6 * model.train().placement(static_cast<Eigen::Index>(i),
                                                   static_cast<Eigen::Index>(bearing));
  }
  const std::vector<double> velocity(model.coordinates(), 0.0);
  std::vector<double> acceleration(model.coordinates(), 0.0);
  Touch touch;
  Spin spin;
  spin.speed_rad_per_s = speed_rad_per_s;
  ModalForces(model, {}, spin, position.data(), velocity.data(), acceleration.data(), touch.report);
  const auto& shape = model.bearings()[bearing].actuator_shape;
  const auto largest = std::max_element(
      shape.begin(), shape.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  const auto mode = static_cast<std::size_t>(largest - shape.begin());
  touch.across_n = acceleration[modes + mode] / shape[mode];
  return touch;
}

// Coulomb friction is smoothed below 0.01 m/s: at 1 m/s it is 5e-5 short of its full value.
constexpr double kSmoothed = 1e-4;

TEST(ContactOfADrivenShaft, IsPushedAgainstItsOwnSenseOfRotation) {
  // 1000 N on the +x side: a shaft that turns from x to y is pushed towards -y, one that turns the
  // other way towards +y.
  EXPECT_NEAR(PressedAgainstTheRing(0, 100.0).across_n, -100.0, 100.0 * kSmoothed);
  EXPECT_NEAR(PressedAgainstTheRing(1, 100.0).across_n, 100.0, 100.0 * kSmoothed);
}

TEST(ContactOfADrivenShaft, TakesPowerFromTheTrainByItsOwnSpeed) {
  // 40 teeth on 20: half the speed, backwards. 100 N at 20 mm are 2 N m there, 1 N m at the motor.
  const Touch driven = PressedAgainstTheRing(1, 100.0);
  EXPECT_NEAR(driven.report.friction_n_m, -1.0, kSmoothed);
  EXPECT_NEAR(driven.report.slip_rad_per_s, 100.0, 1e-9);  // a train that stands slides nowhere
  EXPECT_NEAR(PressedAgainstTheRing(0, 100.0).report.friction_n_m, -2.0, 2.0 * kSmoothed);
  EXPECT_NEAR(PressedAgainstTheRing(1, -100.0).report.friction_n_m, 1.0, kSmoothed);
}

TEST(Brake, ChangesTheSpeedByTorqueOverInertia) {
  Rotation rotation{100.0, 0.0, 0.0};
  Brake(rotation, 2e-3, -4.0, 100.0, 1e-3);
  EXPECT_DOUBLE_EQ(rotation.speed_rad_per_s, 98.0);
}

TEST(Brake, EndsWhereNothingSlidesAnyMore) {
  Rotation rotation{0.5, 0.0, 0.0};
  Brake(rotation, 1e-6, -4.0, 0.5, 1e-3);  // a light rotor: 4000 rad/s too much for one step
  EXPECT_EQ(rotation.speed_rad_per_s, 0.0);
}

TEST(Brake, LeavesTheSpeedWithoutAKnownInertia) {
  Rotation rotation{100.0, 0.0, 0.0};
  Brake(rotation, 0.0, -4.0, 100.0, 1e-3);
  EXPECT_EQ(rotation.speed_rad_per_s, 100.0);
}

PlantConfig Lying(double polar_inertia_kg_m2, double friction) {
  PlantConfig config = test::RigidRotor(2.0);
  config.unbalance.clear();
  config.gravity_m_per_s2 = kGravity;
  config.gravity_direction_rad = -0.5 * std::numbers::pi;
  config.drive = {100.0, 0.0, 0.0, polar_inertia_kg_m2};
  for (auto& b : config.bearings) b.touchdown = {190e-6, 1e6, 500.0, friction, 0.02};
  return config;
}

double SpeedAfter(const PlantConfig& config, double seconds, const PlantCommand& command) {
  Plant plant(config, 1);
  plant.RestInTouchdown();
  plant.SetSpeed(30.0, 0.0);
  for (int n = 0; n < static_cast<int>(std::lround(seconds / 1e-4)); ++n) plant.Advance(command);
  return plant.speed_rad_per_s();
}

// A rotor that lies leans into the friction until normal and tangential force carry its weight.
double Deceleration(double inertia_kg_m2, double friction) {
  return friction * 2.0 * kGravity * 0.02 / (inertia_kg_m2 * std::sqrt(1.0 + friction * friction));
}

TEST(ContactFriction, BrakesACoastingRotorThatLiesInItsTouchdownBearings) {
  const double lost = 0.25 * Deceleration(1e-3, 0.1);  // 9.8 rad/s
  // It swings into its place for the first hundredth of a second, and Coulomb friction is smoothed
  // by 1.4e-4 at 0.6 m/s: some 2 % of what is lost.
  EXPECT_NEAR(SpeedAfter(Lying(1e-3, 0.1), 0.25, Off()), 30.0 - lost, 0.02 * lost);
}

TEST(ContactFriction, LeavesTheSpeedOfARotorOfUnknownInertia) {
  EXPECT_EQ(SpeedAfter(Lying(0.0, 0.1), 0.25, Off()), 30.0);
}

TEST(ContactFriction, WinsOnlyOverADriveWithLessTorque) {
  PlantCommand command = Off();
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = 30.0;
  command.acceleration_limit_rad_per_s2 = 20.0;
  const double taken = Deceleration(1e-3, 0.1);  // 39 rad/s^2
  EXPECT_NEAR(SpeedAfter(Lying(1e-3, 0.1), 0.25, command), 30.0 - 0.25 * (taken - 20.0),
              0.02 * 0.25 * taken);
  command.acceleration_limit_rad_per_s2 = 80.0;
  EXPECT_NEAR(SpeedAfter(Lying(1e-3, 0.1), 0.25, command), 30.0, 2e-4 * taken);  // of one period
}

struct Energy {
  double start_j{}, largest_j{}, end_j{};
};

// Rotation, motion, height and the springs of the touchdown bearings.
double Sum(const Plant& plant, double inertia_kg_m2) {
  const StateLayout& at = plant.layout();
  const auto state = plant.state();
  double sum = 0.5 * inertia_kg_m2 * std::pow(plant.speed_rad_per_s(), 2);
  const auto& gravity = plant.model().gravity();
  for (std::size_t i = 0; i < 2 * at.modes; ++i) {
    sum += 0.5 * std::pow(state[at.v_x + i], 2) - gravity[i] * state[at.q_x + i];
  }
  const AxisArray place_m = plant.ActuatorPosition();
  for (std::size_t b = 0; b < 2; ++b) {
    const auto& ring = plant.model().bearings()[b].touchdown;
    const double deep_m =
        std::max(0.0, std::hypot(place_m[2 * b], place_m[2 * b + 1]) - ring.clearance_m);
    sum += 0.5 * ring.stiffness_n_per_m * deep_m * deep_m;
  }
  return sum;
}

// Thrown at 0.2 m/s against the touchdown bearings, without weight, while it turns at 300 rad/s.
Energy OfAThrow(double plant_inertia_kg_m2) {
  constexpr double kInertia_kg_m2 = 1e-3;
  PlantConfig config = Lying(plant_inertia_kg_m2, 0.3);
  config.gravity_m_per_s2 = 0.0;
  config.substeps = 32;  // it ends in a whirl deep in the ring, where Coulomb's corner is stiff
  Plant plant(config, 1);
  plant.RestInTouchdown();  // amplifiers off, coils empty
  plant.PlaceAtRest({});
  for (std::size_t i = 0; i < 2; ++i) {
    plant.mutable_state()[plant.layout().v_x + i] =
        0.2 * plant.model().rigid()(static_cast<Eigen::Index>(i), 0);
  }
  plant.SetSpeed(300.0, 0.0);
  Energy energy;
  energy.start_j = Sum(plant, kInertia_kg_m2);
  for (int n = 0; n < 5000; ++n) {
    plant.Advance(Off());
    energy.end_j = Sum(plant, kInertia_kg_m2);
    energy.largest_j = std::max(energy.largest_j, energy.end_j);
  }
  return energy;
}

TEST(ThrowPair, FrictionMakesEnergyFromNothingWhileTheSpeedDoesNotFeelIt) {
  const Energy energy = OfAThrow(0.0);
  EXPECT_GT(energy.largest_j, energy.start_j + 0.5);
}

TEST(ThrowPair, ARotorInContactOnlyLosesEnergyWhenItsSpeedFeelsTheFriction) {
  const Energy energy = OfAThrow(1e-3);
  // Torque and speed are those of one substep before: some 1e-5 s of a power below 1 kW.
  EXPECT_LT(energy.largest_j, energy.start_j + 0.01);
  EXPECT_LT(energy.end_j, 0.9 * energy.start_j);
}

}  // namespace
}  // namespace levitas::plant
