// What becomes of a command: delay, converter, coil limits, bias, enabling, drive.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plant_sim/plant/plant.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

constexpr double kTau_s = 1.0 / (2.0 * std::numbers::pi * 720.0);

PlantCommand Levitated(double control_a) {
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.control_current_a = {control_a, control_a, control_a, control_a};
  return command;
}

double Coil(const Plant& plant, std::size_t axis) {
  return plant.state()[plant.layout().coil_current + axis];
}

// Coil current after each of four periods under a step of 0.5 A at the first sample, against the
// closed form of a first-order amplifier that sees the step `delay` periods late.
TEST(Delay, MakesTheCommandActAFractionOfThePeriodLate) {
  for (const double delay : {0.0, 0.25, 0.5, 1.0, 1.75, 2.0}) {
    auto config = test::QuietFlexibleRotor();
    config.delay_samples = delay;
    Plant plant(config, 1);
    for (int n = 1; n <= 4; ++n) {
      plant.Advance(Levitated(0.5));
      const double acted_s = std::max(0.0, n - delay) * 1e-4;
      EXPECT_NEAR(Coil(plant, 0), 0.5 * (1.0 - std::exp(-acted_s / kTau_s)), 1e-12)  // rounding
          << delay << " samples, period " << n;
    }
  }
}

TEST(Delay, OfAlmostAWholeSampleCountsAsWhole) {
  auto config = test::QuietFlexibleRotor();
  config.delay_samples = 1.0 - 1e-12;
  Plant plant(config, 1);
  plant.Advance(Levitated(0.5));
  EXPECT_EQ(Coil(plant, 0), 0.0);
}

TEST(Converter, LetsThroughOnlyItsSteps) {
  auto config = test::QuietFlexibleRotor();
  config.delay_samples = 0.0;
  for (auto& b : config.bearings) b.amplifier.dac_bits = 8;
  Plant plant(config, 1);
  for (int i = 0; i < 100; ++i) plant.Advance(Levitated(0.1));
  // 4 A / 256 = 15.625 mA: 0.1 A becomes 6 steps. 10 ms are 45 time constants.
  EXPECT_NEAR(Coil(plant, 0), 6.0 * 4.0 / 256.0, 1e-12);
}

TEST(Coils, StayBetweenZeroAndTheMaximumHoweverLargeTheCommand) {
  Plant plant(test::QuietFlexibleRotor(), 1);
  for (int i = 0; i < 100; ++i) plant.Advance(Levitated(50.0));
  EXPECT_NEAR(Coil(plant, 0), 1.0, 1e-9);  // i+ = 2 A, i- = 0: control 1 A at bias 1 A
}

TEST(Polarity, OfTheActuatorTurnsTheCurrentAndOnlyThere) {
  auto config = test::QuietFlexibleRotor();
  config.delay_samples = 0.0;
  config.actuator_polarity[1] = -1.0;
  Plant plant(config, 1);
  plant.Advance(Levitated(0.2));
  EXPECT_GT(Coil(plant, 0), 0.0);
  EXPECT_EQ(Coil(plant, 1), -Coil(plant, 0));
}

TEST(Bias, GivesTheForcePerCurrentOfItsPresentValue) {
  auto config = test::QuietFlexibleRotor();
  config.delay_samples = 0.0;
  // ki = 4 k i0/s0^2 = 40 i0 N/A with these magnets.
  for (const double bias_a : {1.0, 0.5}) {
    Plant plant(config, 1);
    PlantCommand command = Levitated(0.001);
    command.bias_current_a = bias_a;
    for (int i = 0; i < 40; ++i) {
      plant.Advance(command);
      for (std::size_t s = 0; s < plant.layout().coil_current; ++s) plant.mutable_state()[s] = 0.0;
    }
    EXPECT_NEAR(plant.MagnetForce()[0], 40.0 * bias_a * 0.001, 1e-7) << bias_a;
  }
}

TEST(Bias, RisesWithTheAmplifiersFromNothing) {
  auto config = test::QuietFlexibleRotor();
  config.delay_samples = 0.0;
  Plant plant(config, 1);
  plant.RestInTouchdown();
  EXPECT_EQ(plant.MagnetForce()[0], 0.0);
  plant.Advance(Levitated(0.25));
  // After one period both have come as far; F = 40 N/A2 x bias x control in the centre.
  const double risen = 1.0 - std::exp(-1e-4 / kTau_s);
  for (std::size_t s = 0; s < plant.layout().coil_current; ++s) plant.mutable_state()[s] = 0.0;
  EXPECT_NEAR(plant.MagnetForce()[0], 40.0 * risen * 0.25 * risen, 1e-9);
}

TEST(Amplifiers, SwitchedOffLetBothCoilsDecayWithTheirOwnTimeConstant) {
  auto config = test::QuietFlexibleRotor();
  config.delay_samples = 0.0;
  Plant plant(config, 1);
  for (int i = 0; i < 100; ++i) plant.Advance(Levitated(0.5));
  EXPECT_EQ(plant.Sample().rig_status & kRigAmplifiersOff, 0U);
  PlantCommand off = Levitated(0.5);
  off.amplifiers_enabled = false;
  const double before_a = Coil(plant, 0);
  for (int i = 0; i < 3; ++i) plant.Advance(off);
  EXPECT_NEAR(Coil(plant, 0), before_a * std::exp(-3e-4 / kTau_s), 1e-12);  // rounding
  EXPECT_NE(plant.Sample().rig_status & kRigAmplifiersOff, 0U);
  for (int i = 0; i < 200; ++i) plant.Advance(off);
  EXPECT_NEAR(plant.MagnetForce()[0], 0.0, 1e-12);
}

TEST(DriveOfThePlant, RunsUpAtTheSmallerOfBothLimits) {
  auto config = test::QuietFlexibleRotor();
  config.drive.max_acceleration_rad_per_s2 = 500.0;
  for (const double asked : {200.0, 5000.0}) {
    Plant plant(config, 1);
    PlantCommand command = Levitated(0.0);
    command.drive_enabled = true;
    command.speed_set_point_rad_per_s = 100.0;
    command.acceleration_limit_rad_per_s2 = asked;
    for (int i = 0; i < 100; ++i) plant.Advance(command);
    EXPECT_NEAR(plant.speed_rad_per_s(), std::min(asked, 500.0) * 0.01, 1e-9);  // 400 sums
  }
}

TEST(DriveOfThePlant, SwitchedOffCoastsByTheClosedForm) {
  auto config = test::QuietFlexibleRotor();
  config.drive = {500.0, 0.5, 10.0};
  Plant plant(config, 1);
  plant.RestInTouchdown();
  plant.SetSpeed(200.0, 1.0);
  PlantCommand command;
  command.amplifiers_enabled = false;
  for (int i = 0; i < 1000; ++i) plant.Advance(command);
  EXPECT_NEAR(plant.speed_rad_per_s(), 220.0 * std::exp(-0.05) - 20.0, 1e-8);  // 4000 sums
  EXPECT_EQ(plant.Sample().speed_rad_per_s, plant.speed_rad_per_s());
}

}  // namespace
}  // namespace levitas::plant
