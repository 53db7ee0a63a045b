#include "plant_sim/plant/linear_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

constexpr double kPeriod_s = 1e-4;
constexpr double kSpeed_rad_per_s = 314.0;

Eigen::VectorXd StateOf(const Plant& plant) {
  const auto state = plant.state();
  return Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<Eigen::Index>(state.size()));
}

PlantCommand Levitated() {
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = kSpeed_rad_per_s;
  return command;
}

// What a state is worth: displacements 1 um sqrt(kg), velocities 1 mm/s, currents 10 mA.
Eigen::VectorXd Scales(const StateLayout& at) {
  Eigen::VectorXd scale(static_cast<Eigen::Index>(at.size));
  for (std::size_t i = 0; i < at.size; ++i) {
    double value = 1e-6;
    if (i >= at.v_x && i < at.coil_current) value = 1e-3;
    if (i >= at.coil_current && i < at.sensor) value = 1e-2;
    scale[static_cast<Eigen::Index>(i)] = value;
  }
  return scale;
}

// One period of the nonlinear plant from the centre with one number disturbed, by central
// differences; `control` is an axis, or -1 for none.
Eigen::VectorXd Response(const PlantConfig& config, std::ptrdiff_t index, int control, double by) {
  Eigen::VectorXd result;
  for (const double sign : {1.0, -1.0}) {
    Plant plant(config, 1);
    plant.SetSpeed(kSpeed_rad_per_s, 0.0);
    PlantCommand command = Levitated();
    if (index >= 0) plant.mutable_state()[static_cast<std::size_t>(index)] = sign * by;
    if (control >= 0) {
      command.control_current_a[static_cast<std::size_t>(control)] = sign * by;
    }
    plant.Advance(command);
    if (sign > 0.0) {
      result = StateOf(plant);
    } else {
      result -= StateOf(plant);
    }
  }
  return result / (2.0 * by);
}

void ExpectJacobian(PlantConfig config, int substeps, double tolerance) {
  config.delay_samples = 0.0;
  config.substeps = substeps;
  const auto model = Discretise(Linearise(config, kSpeed_rad_per_s), kPeriod_s, 0.0);
  const Eigen::VectorXd scale = Scales(Plant(config, 1).layout());
  for (Eigen::Index i = 0; i < model.a.cols(); ++i) {
    const Eigen::VectorXd difference =
        (Response(config, i, -1, scale[i]) - model.a.col(i)) * scale[i];
    EXPECT_LT(difference.cwiseQuotient(scale).cwiseAbs().maxCoeff(), tolerance) << "state " << i;
  }
  for (int axis = 0; axis < 4; ++axis) {
    const Eigen::VectorXd difference =
        (Response(config, -1, axis, 0.01) - model.b.col(axis)) * 0.01;
    EXPECT_LT(difference.cwiseQuotient(scale).cwiseAbs().maxCoeff(), tolerance) << "axis " << axis;
  }
}

TEST(LinearModel, IsTheJacobianOfTheNonlinearPlant) {
  // Entries are of order one in these scales. The step's error falls with the square of the
  // substep: 4e-4 of the peak at 4 substeps is 2e-6 at 64; the cubic term of the magnet adds 1e-5.
  ExpectJacobian(test::QuietFlexibleRotor(), 64, 2e-5);
}

TEST(LinearModel, IsTheJacobianWithEddyCurrentsInTurnedMagnets) {
  auto config = test::QuietFlexibleRotor();
  config.effects = {levitas::test::Entry(effect::Id::kEddyCurrent, {80e-6, 1.0}),
                    levitas::test::Entry(effect::Id::kAxisRotation, {0.1})};
  // The fastest lag relaxes in 0.8 us: 1.6 us of substep leave 3e-2, a quarter of that half the
  // substep, and 0.2 us a sixty-fourth.
  ExpectJacobian(config, 512, 1e-3);
}

TEST(LinearModel, ReadsTheSensorsOfTheBearingFrame) {
  auto config = test::QuietFlexibleRotor();
  const auto model = Linearise(config, 0.0);
  EXPECT_EQ(model.c.rows(), 4);
  config.sensor_polarity[2] = -1.0;
  config.actuator_polarity[0] = -1.0;
  const auto wired = Linearise(config, 0.0);
  EXPECT_EQ(wired.c, model.c);  // how the probe is wired is undone before a law sees it
  EXPECT_EQ(wired.b, model.b);
}

TEST(LinearModel, ScalesWithTheDesignBiasAndTheSensorGain) {
  auto config = test::QuietFlexibleRotor();
  const auto one = Linearise(config, 0.0);
  for (auto& b : config.bearings) {
    b.magnet.bias_current_a = 0.5;
    b.sensor.gain = 2.0;
  }
  const auto half = Linearise(config, 0.0);
  const StateLayout at = Plant(config, 1).layout();
  const auto v = static_cast<Eigen::Index>(at.v_x);
  const auto coil = static_cast<Eigen::Index>(at.coil_current);
  const auto sensor = static_cast<Eigen::Index>(at.sensor);
  EXPECT_NEAR(half.a(v, coil) / one.a(v, coil), 0.5, 1e-12);  // ki is linear in the bias
  EXPECT_NEAR(half.a(v, 0) / one.a(v, 0), 0.25, 1e-12);       // ks is quadratic
  EXPECT_NEAR(half.a(sensor, 0) / one.a(sensor, 0), 2.0, 1e-12);
}

// Drives plant and sampled model with the same commands from the same disturbed state.
double LargestDifference(double delay_samples) {
  auto config = test::QuietFlexibleRotor();
  config.unbalance.clear();
  config.delay_samples = delay_samples;
  config.substeps = 64;
  const auto model = Discretise(Linearise(config, kSpeed_rad_per_s), kPeriod_s, delay_samples);
  Plant plant(config, 1);
  plant.SetSpeed(kSpeed_rad_per_s, 0.0);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(model.a.rows());
  double difference = 0.0;
  double peak = 0.0;
  PlantCommand command = Levitated();
  for (int n = 0; n < 30; ++n) {
    const Eigen::VectorXd y = model.c * x;
    const AxisArray output_m = plant.SensorOutput();
    Eigen::VectorXd u(4);
    for (Eigen::Index axis = 0; axis < 4; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      difference = std::max(difference, std::abs(output_m[a] - y[axis]));
      peak = std::max(peak, std::abs(y[axis]));
      // Small enough that the magnets stay linear: below 1 um.
      u[axis] = 0.002 * std::sin(0.7 * n + static_cast<double>(axis));
      command.control_current_a[a] = u[axis];
    }
    plant.Advance(command);
    x = model.a * x + model.b * u;
  }
  return difference / peak;
}

TEST(Discretise, FollowsThePlantForWholeAndFractionalDelays) {
  for (const double delay : {0.0, 0.5, 1.0, 1.25, 3.0, 2.9}) {
    // Displacements of 1e-3 of the gap leave the magnet's square at 1e-6; the rest is the substep.
    EXPECT_LT(LargestDifference(delay), 1e-4) << delay << " samples";
  }
}

TEST(Discretise, NeedsOneStatePerAxisAndPendingCommand) {
  const auto continuous = Linearise(test::QuietFlexibleRotor(), 0.0);
  const Eigen::Index n = continuous.a.rows();
  EXPECT_EQ(Discretise(continuous, kPeriod_s, 0.0).a.rows(), n);
  EXPECT_EQ(Discretise(continuous, kPeriod_s, 1.0).a.rows(), n + 4);
  EXPECT_EQ(Discretise(continuous, kPeriod_s, 1.5).a.rows(), n + 8);
}

TEST(Discretise, RefusesATimeThatCannotBe) {
  const auto continuous = Linearise(test::QuietFlexibleRotor(), 0.0);
  EXPECT_THROW((void)Discretise(continuous, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW((void)Discretise(continuous, kPeriod_s, -0.1), std::invalid_argument);
  EXPECT_THROW((void)Discretise(continuous, std::nan(""), 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::plant
