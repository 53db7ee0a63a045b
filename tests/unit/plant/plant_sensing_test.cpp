// What the sensors tell: noise, converter, polarity, frame contents.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "plant_sim/plant/plant.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

TEST(SensorNoise, IsWhiteWithTheWrittenDeviationAndIndependentPerChannel) {
  auto config = test::QuietFlexibleRotor();
  for (auto& b : config.bearings) b.sensor.noise_rms_m = 1e-6;
  Plant plant(config, 20261121);
  constexpr int kCount = 40'000;
  std::array<double, 4> mean{}, square{}, lag{}, last{};
  double cross = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const auto y = plant.Sample().position_m;
    for (std::size_t a = 0; a < 4; ++a) {
      const double value = y[a] / 1e-6;
      mean[a] += value / kCount;
      square[a] += value * value / kCount;
      lag[a] += value * last[a] / kCount;
      last[a] = value;
    }
    cross += y[0] * y[3] / 1e-12 / kCount;
  }
  // Five standard deviations of each estimate: 1/sqrt(n), and sqrt(2/n) for the square.
  const double five = 5.0 / std::sqrt(kCount);
  for (std::size_t a = 0; a < 4; ++a) {
    EXPECT_NEAR(mean[a], 0.0, five);
    EXPECT_NEAR(square[a], 1.0, std::sqrt(2.0) * five);
    EXPECT_NEAR(lag[a], 0.0, five);
  }
  EXPECT_NEAR(cross, 0.0, five);
}

TEST(SensorNoise, IsAbsentFromTheNoiseFreeOutput) {
  auto config = test::FlexibleRotor();
  Plant plant(config, 1);
  plant.PlaceAtRest({10e-6, 0.0, 10e-6, 0.0});
  EXPECT_NEAR(plant.SensorOutput()[0], 10e-6, 1e-15);
  (void)plant.Sample();
  EXPECT_NEAR(plant.SensorOutput()[0], 10e-6, 1e-15);
}

TEST(Converter, GivesWholeStepsAndClipsAtItsRange) {
  auto config = test::QuietFlexibleRotor();
  for (auto& b : config.bearings) b.sensor.adc_bits = 8;
  Plant plant(config, 1);
  plant.PlaceAtRest({10e-6, -10e-6, 10e-6, -500e-6});
  const auto y = plant.Sample().position_m;
  const double step_m = 800e-6 / 256.0;
  EXPECT_NEAR(y[0], 3.0 * step_m, 1e-15);  // 10 um is 3.2 steps
  EXPECT_NEAR(y[1] / step_m, std::round(y[1] / step_m), 1e-9);
  EXPECT_EQ(y[3], -400e-6);
}

TEST(Polarity, OfTheSensorTurnsTheReadingAndOnlyThere) {
  auto config = test::QuietFlexibleRotor();
  config.sensor_polarity = {1.0, 1.0, -1.0, 1.0};
  Plant plant(config, 1);
  plant.PlaceAtRest({10e-6, 0.0, 10e-6, 0.0});
  EXPECT_NEAR(plant.Sample().position_m[2], -10e-6, 1e-15);
  EXPECT_NEAR(plant.SensorOutput()[2], -10e-6, 1e-15);
  EXPECT_NEAR(plant.ActuatorPosition()[2], 10e-6, 1e-15);
}

TEST(Sensors, LookAtTheirOwnPlaneNotAtTheActuator) {
  Plant plant(test::QuietFlexibleRotor(), 1);
  // DE actuator at 0.1299 m displaced by 60 um, NDE at 0.3996 m in the centre: the sensor at
  // 0.1099 m, outside the bearings, sees the straight line through both.
  plant.PlaceAtRest({60e-6, 0.0, 0.0, 0.0});
  const double slope = -60e-6 / (0.3996 - 0.1299);
  EXPECT_NEAR(plant.SensorOutput()[0], 60e-6 - 0.02 * slope, 1e-13);
  EXPECT_NEAR(plant.SensorOutput()[2], 0.02 * slope, 1e-13);
}

TEST(Frame, CountsPeriodsAndCarriesTheRotation) {
  Plant plant(test::QuietFlexibleRotor(), 1);
  plant.SetSpeed(100.0, 1.5);
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = 100.0;
  for (int i = 0; i < 7; ++i) {
    (void)plant.Sample();
    plant.Advance(command);
  }
  const SensorFrame frame = plant.Sample();
  EXPECT_EQ(frame.cycle, 7U);
  EXPECT_EQ(frame.sample_time_ns, 700'000);
  EXPECT_EQ(frame.axes, 4U);
  EXPECT_DOUBLE_EQ(frame.speed_rad_per_s, 100.0);
  EXPECT_NEAR(frame.angle_rad, 1.5 + 0.07, 1e-12);
  EXPECT_EQ(plant.cycle(), 7U);
}

}  // namespace
}  // namespace levitas::plant
