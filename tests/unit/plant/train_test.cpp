// Geared shafts within the plant: ratios, angles, placement, contracts of the time step.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/problem.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/parameter_access.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/plant/train_model.hpp"
#include "plant_sim/plant/train_step.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/geared_rigs.hpp"

namespace levitas::plant {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

TEST(SpeedRatios, FollowTheTeethThroughEveryPair) {
  PlantConfig config = test::GearedRotor4();
  config.shafts.push_back(config.shafts[1]);
  gear::GearPair second = config.gears[0];
  second.driving.shaft = 1;
  second.driving.teeth = 15;
  second.driven.shaft = 2;
  second.driven.teeth = 45;
  config.gears.insert(config.gears.begin(), second);  // in any order
  const auto ratio = SpeedRatios(config);
  ASSERT_EQ(ratio.size(), 3U);
  EXPECT_EQ(ratio[0], 1.0);
  EXPECT_EQ(ratio[1], -0.5);
  EXPECT_DOUBLE_EQ(ratio[2], 0.5 / 3.0);
  // 2 turns bring back the second shaft, 6 the third.
  EXPECT_EQ(PlantModel(config).train().turns_per_repeat, 6.0);
}

TEST(SpeedRatios, RefuseAShaftThatNothingTurns) {
  PlantConfig config = test::GearedRotor4();
  config.shafts.push_back(config.shafts[1]);
  EXPECT_THROW((void)SpeedRatios(config), std::invalid_argument);
  EXPECT_THROW((void)PlantModel(config), std::invalid_argument);
}

TEST(TrainPose, CountsTurnsUntilTheGearsStandAlike) {
  const PlantModel model(test::GearedRotor4());
  TrainPose pose;
  Rotation rotation{100.0, 0.0, 0.0};
  double total_rad = 0.0;
  for (int n = 0; n < 1000; ++n) {
    total_rad += 0.37;
    rotation.angle_rad = Wrapped(total_rad);
    Follow(model.train(), rotation, pose);
    EXPECT_NEAR(std::remainder(pose.shaft_rad[1] + 0.5 * total_rad, kTurn), 0.0, 1e-9);
    EXPECT_NEAR(pose.mesh[0].x, std::cos(20.0 * total_rad), 1e-9);
    EXPECT_LT(pose.turns, 2.0);
  }
  for (int n = 0; n < 1000; ++n) {  // and backwards
    total_rad -= 0.41;
    rotation.angle_rad = Wrapped(total_rad);
    Follow(model.train(), rotation, pose);
    EXPECT_NEAR(std::remainder(pose.shaft_rad[1] + 0.5 * total_rad, kTurn), 0.0, 1e-9);
    EXPECT_GE(pose.turns, 0.0);
  }
}

TEST(GearedPlant, IsPlacedWhereItIsAskedTo) {
  for (const auto& config : {test::GearedRotor4(), test::GearedRotor8(), test::GearedRotor12()}) {
    Plant plant(config, 1);
    const AxisArray wanted_m{10e-6, -20e-6, 30e-6, 5e-6};
    plant.PlaceAtRest(wanted_m);
    for (std::size_t axis = 0; axis < 4; ++axis) {
      EXPECT_NEAR(plant.ActuatorPosition()[axis], wanted_m[axis], 1e-15);
      EXPECT_NEAR(plant.SensorOutput()[axis], wanted_m[axis], 1e-15);
    }
  }
}

TEST(GearedPlant, RestsInItsOwnSupportsWithoutCurrent) {
  Plant plant(test::GearedRotor12(), 1);
  plant.RestInTouchdown();
  for (const double value : plant.state()) EXPECT_EQ(value, 0.0);
}

TEST(GearedPlant, AllocatesNothingWhileItRuns) {
  Plant plant(test::GearedRotor12(), 1);
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = 100.0;
  command.acceleration_limit_rad_per_s2 = 1000.0;
  const test::AllocationGuard guard;
  for (int n = 0; n < 1000; ++n) {
    (void)plant.Sample();
    plant.Advance(command);
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_TRUE(plant.finite());
}

TEST(GearedPlant, RepeatsBitForBit) {
  const auto run = [] {
    Plant plant(test::GearedRotor12(), 7);
    plant.SetSpeed(150.0, 0.3);
    PlantCommand command;
    command.bias_current_a = 1.0;
    for (int n = 0; n < 500; ++n) plant.Advance(command);
    return std::vector<double>(plant.state().begin(), plant.state().end());
  };
  EXPECT_EQ(run(), run());
}

// One period of the plant from a small state against the sampled linear model.
TEST(GearedPlant, AgreesWithItsLinearModelWhereThatHolds) {
  for (auto config : {test::GearedRotor8(), test::GearedRotor12()}) {
    config.gears[0].transmission_error.clear();
    config.gears[0].driving.runout_m = config.gears[0].driven.runout_m = 0.0;
    config.substeps = 64;  // the time step itself is not what is compared
    const PlantModel model(config);
    const LinearModel sampled = Discretise(Linearise(model, 120.0), 1e-4, 1.0);
    Plant plant(config, 1);
    plant.SetSpeed(120.0, 0.0);
    auto state = plant.mutable_state();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(sampled.a.rows());
    for (std::size_t i = 0; i < model.layout().coil_current; ++i) {
      const bool velocity = i >= model.layout().v_x;
      state[i] =
          (velocity ? 1e-5 : 1e-8) * (i % 3 == 0 ? -1.0 : 1.0 + 0.1 * static_cast<double>(i));
      x[static_cast<Eigen::Index>(i)] = state[i];
    }
    PlantCommand command;
    command.bias_current_a = 1.0;
    command.drive_enabled = true;
    command.speed_set_point_rad_per_s = 120.0;
    for (int n = 0; n < 50; ++n) {
      plant.Advance(command);
      x = sampled.a * x;
    }
    const double largest =
        x.head(static_cast<Eigen::Index>(model.layout().v_x)).cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < model.layout().v_x; ++i) {
      // Trapezoid of the coupling forces in steps of 1.6 us: below 1e-5 of the motion.
      EXPECT_NEAR(plant.state()[i], x[static_cast<Eigen::Index>(i)], 1e-4 * largest) << i;
    }
  }
}

TEST(GearedPlant, HasItsGearParametersByName) {
  PlantParameters p = Reduce(test::GearedRotor4());
  EXPECT_EQ(GetParameter(p, "gears[0].stiffness_n_per_m"), 1e6);
  EXPECT_EQ(GetParameter(p, "gears[0].driven.runout_phase_rad"), 0.9);
  EXPECT_EQ(GetParameter(p, "gears[0].transmission_error[3].amplitude_m"), 6e-6);
  SetParameter(p, "gears[0].damping_n_s_per_m", 500.0);
  EXPECT_EQ(PlantModel(p).train().meshes[0].law.damping_n_s_per_m, 500.0);
  EXPECT_THROW((void)GetParameter(p, "gears[1].stiffness_n_per_m"), BadInput);
}

TEST(GearedPlant, RefusesWhatCannotBe) {
  const auto refused = [](auto change) {
    PlantConfig config = test::GearedRotor12();
    change(config);
    EXPECT_THROW((void)PlantModel(config), std::invalid_argument);
  };
  refused([](PlantConfig& c) { c.gravity_m_per_s2 = 9.81; });
  refused([](PlantConfig& c) { c.gears[0].stiffness_n_per_m = 0.0; });
  refused([](PlantConfig& c) { c.gears[0].driven.teeth = 0; });
  refused([](PlantConfig& c) { c.gears[0].driven.shaft = 2; });
  refused([](PlantConfig& c) { c.bearings[0].shaft = 5; });
  refused([](PlantConfig& c) { c.bearings[0].actuator_z_m = 0.1; });
  refused([](PlantConfig& c) { c.gears[0].driving.base_radius_m = 0.0; });
  refused([](PlantConfig& c) { c.shafts[0].torsion.kind = rotor::TorsionKind::kBeam; });
  refused([](PlantConfig& c) { c.unbalance.push_back({0.2, 1e-6, 0.0, 7}); });
}

TEST(Unbalance, OfTheDrivenShaftTurnsBackwardsAtItsOwnSpeed) {
  PlantConfig config = test::GearedRotor4();
  config.gears[0].transmission_error.clear();
  config.gears[0].driving.runout_m = config.gears[0].driven.runout_m = 0.0;
  config.unbalance = {{0.0, 1e-4, 0.5, 1}};
  const PlantModel model(config);
  TrainPose pose;
  const double speed = 80.0;
  Follow(model.train(), {speed, 1.0, 0.0}, pose);
  std::vector<double> zero(4, 0.0);
  std::vector<double> acceleration(4, 0.0);
  AddTrain(model.train(), pose, 2, zero.data(), zero.data(), acceleration.data());
  // u w^2 exp(-j (w t) + j phase), over the root of the modal mass.
  const double force_n = 1e-4 * 0.25 * speed * speed;
  const double shape = model.parameters().modes.ShapeAt(0.0, 1)[1];
  EXPECT_NEAR(acceleration[1], shape * force_n * std::cos(0.5 - 0.5), 1e-12);
  EXPECT_NEAR(acceleration[3], shape * force_n * std::sin(0.5 - 0.5), 1e-12);
  EXPECT_EQ(acceleration[0], 0.0);
}

}  // namespace
}  // namespace levitas::plant
