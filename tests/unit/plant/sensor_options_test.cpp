// Second-order filters and measured curves of the probes in the plant's step and linear model.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>

#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/mode_step.hpp"
#include "plant_sim/plant/plain_sensors.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/sensor/sensor.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

constexpr double kFilterHz = 400.0;
constexpr double kStepM = 10e-6;

PlantConfig WithFilter(SensorFilter filter) {
  PlantConfig config = test::QuietFlexibleRotor();
  for (BearingConfig& bearing : config.bearings) {
    bearing.sensor.filter = filter;
    bearing.sensor.bandwidth_hz = kFilterHz;
  }
  return config;
}

/// A rotor that stands still off the centre, with hardly any current, and filters that begin at 0.
Plant Stepped(PlantConfig config) {
  config.unbalance.clear();
  for (BearingConfig& bearing : config.bearings) bearing.magnet.bias_current_a = 1e-7;
  Plant plant(config, 1);
  plant.PlaceAtRest({kStepM, 0.0, kStepM, 0.0});
  const StateLayout at = plant.layout();
  const auto state = plant.mutable_state();
  for (std::size_t axis = 0; axis < 4; ++axis) state[at.sensor + axis] = 0.0;
  return plant;
}

TEST(ButterworthSensor, AnswersAStepWithTheClosedForm) {
  const PlantConfig config = WithFilter(SensorFilter::kButterworth2);
  Plant plant = Stepped(config);
  const double period_s = static_cast<double>(config.period_ns) * 1e-9;
  for (int n = 1; n <= 60; ++n) {
    plant.Advance({});
    const double a = 2.0 * std::numbers::pi * kFilterHz / std::numbers::sqrt2 * n * period_s;
    const double expected = kStepM * (1.0 - std::exp(-a) * (std::cos(a) + std::sin(a)));
    // The magnets' pull at 0.1 uA moves the rotor by far less than this.
    EXPECT_NEAR(plant.SensorOutput()[0], expected, 1e-8 * kStepM) << n;
  }
}

TEST(ButterworthSensor, IsNotWhatTheFirstOrderDoes) {
  Plant second = Stepped(WithFilter(SensorFilter::kButterworth2));
  Plant first = Stepped(WithFilter(SensorFilter::kFirstOrder));
  const double period_s = static_cast<double>(WithFilter({}).period_ns) * 1e-9;
  second.Advance({});
  first.Advance({});
  EXPECT_NEAR(first.SensorOutput()[0],
              -kStepM * std::expm1(-2.0 * std::numbers::pi * kFilterHz * period_s), 1e-8 * kStepM);
  EXPECT_LT(second.SensorOutput()[0], 0.5 * first.SensorOutput()[0]);
}

TEST(ButterworthSensor, HasTheGainAndPhaseOfTheAnalyticFilterInTheLinearModel) {
  const PlantConfig config = WithFilter(SensorFilter::kButterworth2);
  const LinearModel model = Linearise(config, 0.0);
  const StateLayout at = Plant(config, 1).layout();
  ASSERT_EQ(at.sensor_rates, 4U);
  const auto s = static_cast<Eigen::Index>(at.sensor);
  const auto rate = static_cast<Eigen::Index>(at.sensor_rate());
  const double w = 2.0 * std::numbers::pi * kFilterHz;
  Eigen::Matrix2cd a;
  a << model.a(s, s), model.a(s, rate), model.a(rate, s), model.a(rate, rate);
  // The displacement reaches it through the first mode; its weight divided by that of the filter.
  const LinearModel plain = Linearise(WithFilter(SensorFilter::kFirstOrder), 0.0);
  const double drive = model.a(rate, 0) / (plain.a(s, 0) / w);
  for (const double f : {1.0, 100.0, 400.0, 2000.0}) {
    const std::complex<double> jw(0.0, 2.0 * std::numbers::pi * f);
    const Eigen::Vector2cd x =
        (jw * Eigen::Matrix2cd::Identity() - a).inverse() * Eigen::Vector2cd(0.0, drive);
    const std::complex<double> ratio = jw / w;
    const auto expected = 1.0 / (ratio * ratio + std::numbers::sqrt2 * ratio + 1.0);
    EXPECT_NEAR(std::abs(x[0] - expected), 0.0, 1e-12) << f;
  }
  // -3 dB at its bandwidth.
  const std::complex<double> jw(0.0, w);
  const Eigen::Vector2cd edge =
      (jw * Eigen::Matrix2cd::Identity() - a).inverse() * Eigen::Vector2cd(0.0, drive);
  EXPECT_NEAR(std::abs(edge[0]), std::sqrt(0.5), 1e-12);
}

/// Largest |plant - sampled linear model| of the readings over the largest reading.
double Apart(const PlantConfig& given) {
  PlantConfig config = given;
  config.unbalance.clear();
  config.substeps = 64;
  const double period_s = static_cast<double>(config.period_ns) * 1e-9;
  const LinearModel model = Discretise(Linearise(config, 0.0), period_s, config.delay_samples);
  Plant plant(config, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(model.a.rows());
  double apart = 0.0;
  double peak = 0.0;
  PlantCommand command;
  command.bias_current_a = config.bearings.front().magnet.bias_current_a;
  for (int n = 0; n < 30; ++n) {
    const Eigen::VectorXd y = model.c * x;
    Eigen::VectorXd u(4);
    for (Eigen::Index axis = 0; axis < 4; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      apart = std::max(apart, std::abs(plant.SensorOutput()[a] - y[axis]));
      peak = std::max(peak, std::abs(y[axis]));
      u[axis] = 0.002 * std::sin(0.7 * n + static_cast<double>(axis));
      command.control_current_a[a] = u[axis];
    }
    x = model.a * x + model.b * u;
    plant.Advance(command);
  }
  return apart / peak;
}

TEST(ButterworthSensor, StepsAsTheSampledLinearModelDoes) {
  // The plant's step is of second order in the substep (64 a period): below 1 %, as without.
  EXPECT_LT(Apart(WithFilter(SensorFilter::kFirstOrder)), 0.01);
  EXPECT_LT(Apart(WithFilter(SensorFilter::kButterworth2)), 0.01);
}

TEST(ButterworthSensor, OnOneBearingLeavesTheOtherAsItWas) {
  PlantConfig mixed = WithFilter(SensorFilter::kFirstOrder);
  mixed.bearings[1].sensor.filter = SensorFilter::kButterworth2;
  Plant one = Stepped(mixed);
  Plant other = Stepped(WithFilter(SensorFilter::kFirstOrder));
  one.Advance({});
  other.Advance({});
  EXPECT_EQ(one.SensorOutput()[0], other.SensorOutput()[0]);
  EXPECT_NE(one.SensorOutput()[2], other.SensorOutput()[2]);
}

TEST(FirstOrderSensor, HasNoFurtherStates) {
  const PlantConfig config = WithFilter(SensorFilter::kFirstOrder);
  const StateLayout at = Plant(config, 1).layout();
  EXPECT_EQ(at.sensor_rates, 0U);
  EXPECT_EQ(at.effects, at.sensor + 4);
}

TEST(MeasuredCurve, IsReadInsteadOfTheDisplacement) {
  PlantConfig config = test::QuietFlexibleRotor();
  Plant straight(config, 1);
  config.bearings[0].sensor.characteristic = {{-1e-4, -1e-4}, {0.0, 0.0}, {1e-4, 5e-5}};
  Plant bent(config, 1);
  straight.PlaceAtRest({150e-6, 0.0, 150e-6, 0.0});
  bent.PlaceAtRest({150e-6, 0.0, 150e-6, 0.0});
  EXPECT_NEAR(straight.SensorOutput()[0], 150e-6, 1e-15);
  EXPECT_NEAR(bent.SensorOutput()[0], 50e-6 + 0.5 * 50e-6, 1e-15);  // beyond the table: its end
  EXPECT_NEAR(bent.SensorOutput()[2], 150e-6, 1e-15);
  EXPECT_NEAR(bent.ActuatorPosition()[0], 150e-6, 1e-15);
}

TEST(MeasuredCurve, ScalesTheLinearModelByItsSlopeAtTheCentre) {
  PlantConfig config = test::QuietFlexibleRotor();
  const LinearModel straight = Linearise(config, 0.0);
  config.bearings[0].sensor.characteristic = {{-1e-4, -1e-4}, {0.0, 0.0}, {1e-4, 5e-5}};
  const LinearModel bent = Linearise(config, 0.0);
  const auto s = static_cast<Eigen::Index>(Plant(config, 1).layout().sensor);
  EXPECT_NEAR(bent.a(s, 0) / straight.a(s, 0), 2.0 / 3.0, 1e-12);
  EXPECT_EQ(bent.a(s + 2, 0), straight.a(s + 2, 0));
}

TEST(MeasuredCurve, ThatDescendsIsRefused) {
  PlantConfig config = test::QuietFlexibleRotor();
  config.bearings[0].sensor.characteristic = {{-1e-4, 1e-4}, {0.0, 0.0}};
  EXPECT_THROW(Plant(config, 1), std::invalid_argument);
}

TEST(HasPlainSensors, IsSaidOfFirstOrderAndStraightOnly) {
  PlantConfig config = test::QuietFlexibleRotor();
  EXPECT_TRUE(HasPlainSensors(config));
  EXPECT_FALSE(HasPlainSensors(WithFilter(SensorFilter::kButterworth2)));
  config.bearings[1].sensor.characteristic = {{0.0, 0.0}, {1e-4, 5e-5}};
  EXPECT_FALSE(HasPlainSensors(config));
}

}  // namespace
}  // namespace levitas::plant
