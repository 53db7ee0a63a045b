// What the linear model says of a loaded rotor, against closed forms and against a measurement on
// the nonlinear plant: one axis excited with a small sine, all axes levitated, as ISO 14839-3 asks.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <tuple>

#include "analysis/poles.hpp"
#include "analysis/sensitivity.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"
#include "controller/law/axis_law.hpp"
#include "plant_sim/plant/find_operating_point.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant.hpp"
#include "tests/support/test_rigs.hpp"
#include "tests/unit/analysis/laws.hpp"

namespace levitas::analysis {
namespace {

plant::StaticLaw Integrating(std::size_t axes) {
  const auto n = static_cast<Eigen::Index>(axes);
  return {Eigen::MatrixXd::Zero(n, n), std::vector<bool>(axes, true), 0.0};
}

// Force law (14) at x = 0: F = ki ic exactly, and dF/dx = ks (1 + (ic/i0)^2).
TEST(OperatingPoint, StiffensTheMagnetWithTheSquareOfItsStaticCurrent) {
  plant::PlantConfig config = test::RigidCylinder();
  config.gravity_m_per_s2 = 9.81;
  config.gravity_direction_rad = std::numbers::pi;
  const plant::PlantModel model(config);
  const auto point = plant::FindOperatingPoint(model, 0.0, Integrating(4));
  ASSERT_EQ(point.failure, "");
  const auto& magnet = config.bearings[0].magnet;
  const double k = magnet.force_constant_n_m2_per_a2;
  const double ki = 4.0 * k * magnet.bias_current_a / std::pow(magnet.gap_m, 2);
  const double ks = ki * magnet.bias_current_a / magnet.gap_m;
  const double radius = 0.5 * test::kCylinderDiameter;
  const double mass =
      std::numbers::pi * radius * radius * test::kCylinderLength * test::kCylinderDensity;
  const double ic0 = 0.5 * mass * 9.81 / ki;
  // The finite elements have the mass to rounding; Newton's method ends at 1e-10 A.
  EXPECT_NEAR(point.control_a[0], ic0, 1e-6 * ic0);
  EXPECT_NEAR(point.control_a[1], 0.0, 1e-9);
  EXPECT_NEAR(point.displacement_m[0], 0.0, 1e-12);
  const plant::Slopes slopes = plant::SlopesAt(model, 0, point);
  const double ratio = ic0 / magnet.bias_current_a;
  // Central differences of a share 1e-5: error of its square, times the curvature's factor.
  EXPECT_NEAR(slopes.displacement(0, 0), ks * (1.0 + ratio * ratio), 1e-7 * ks);
  EXPECT_NEAR(slopes.displacement(1, 1), ks, 1e-7 * ks);
  EXPECT_NEAR(slopes.current(0, 0), ki, 1e-7 * ki);
}

// Without an integrator the rotor sags until law and magnet carry it: F(ic0, x0) = m g, ic = -Kp x.
TEST(OperatingPoint, SagsWithoutIntegratorToWhereTheTrueForceCarriesTheLoad) {
  const auto rig = configuration::LoadRig(configuration::FindConfig("one_axis", "rigs"));
  auto controller = configuration::LoadController(
      configuration::FindConfig("one_axis", "controllers"), rig.numbers);
  controller.law.axes[0].ki_a_per_m_s = 0.0;
  const auto poles = ClosedLoopPoles(rig.plant, controller.law, 0.0);
  ASSERT_EQ(poles.point.failure, "");
  const double x = poles.point.displacement_m[0];
  const double ic = poles.point.control_a[0];
  EXPECT_LT(x, 0.0);
  // Sensor and law have no other gain at rest.
  EXPECT_NEAR(ic, -controller.law.axes[0].kp_a_per_m * x, 1e-9);
  const auto& m = rig.plant.bearings[0].magnet;
  const double i0 = m.bias_current_a;
  const double force = m.force_constant_n_m2_per_a2 * (std::pow((i0 + ic) / (m.gap_m - x), 2) -
                                                       std::pow((i0 - ic) / (m.gap_m + x), 2));
  EXPECT_NEAR(force, 0.5 * 9.81, 1e-6);  // half a kilogram; Newton's method ends at 1e-10 A
}

TEST(OperatingPoint, NamesTheAxisWhoseMagnetsCannotCarryTheLoad) {
  auto rig = configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  const auto controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers);
  // 2.33 kg on two bearings whose axes stand at 45 degrees: 40 N at 1 A would be passed.
  rig.plant.gravity_m_per_s2 = 60.0;
  const auto result = SensitivityPeaks(rig.plant, controller.law, 0.0);
  EXPECT_FALSE(result.stable);
  EXPECT_FALSE(result.zone.has_value());
  EXPECT_NE(result.point.failure.find("cannot carry the load"), std::string::npos);
}

/// Rig and law alone, on the nonlinear plant.
class Bench {
 public:
  Bench(const plant::PlantConfig& rig, law::LawConfig law)
      : rig_(rig), plant_(rig, 1), coefficients_(law), state_(coefficients_) {
    command_.bias_current_a = rig.bearings[0].magnet.bias_current_a;
    command_.drive_enabled = true;
    limit_a_ = 1.0;
  }
  void Spin(double speed_rad_per_s) {
    plant_.SetSpeed(speed_rad_per_s, 0.0);
    command_.speed_set_point_rad_per_s = speed_rad_per_s;
    command_.acceleration_limit_rad_per_s2 = rig_.drive.max_acceleration_rad_per_s2;
  }
  /// One period; the command of `axis`, the added current in it.
  double Step(std::size_t axis, double excitation_a) {
    AxisArray error_m{};
    const AxisArray seen_m = plant_.SensorOutput();
    for (std::size_t i = 0; i < 4; ++i) error_m[i] = -seen_m[i] * rig_.sensor_polarity[i];
    const law::LawOutput out = law::Step(coefficients_, state_, error_m, {}, limit_a_);
    AxisArray current_a = out.control_current_a;
    current_a[axis] += excitation_a;
    for (std::size_t i = 0; i < 4; ++i) {
      command_.control_current_a[i] = rig_.actuator_polarity[i] * current_a[i];
    }
    plant_.Advance(command_);
    return current_a[axis];
  }
  /// |S_ii| at a frequency: amplitude of the command over that of the excitation.
  double Measure(std::size_t axis, double frequency_hz) const {
    Bench bench = *this;
    const double amplitude_a = 2e-3;
    const double turn = 2.0 * std::numbers::pi * frequency_hz * 1e-4;
    const auto settle = static_cast<int>(1.0 / 1e-4);
    const auto periods = std::max(10.0, std::round(0.3 * frequency_hz));
    const auto count = static_cast<int>(std::round(periods / frequency_hz / 1e-4));
    std::complex<double> sum{};
    for (int n = 0; n < settle + count; ++n) {
      const double command_a = bench.Step(axis, amplitude_a * std::cos(turn * n)) - mean_a_[axis];
      if (n >= settle) sum += command_a * std::polar(1.0, -turn * n);
    }
    return 2.0 * std::abs(sum) / count / amplitude_a;
  }
  void Settle() {
    for (int n = 0; n < 30'000; ++n) {
      for (std::size_t axis = 0; axis < 1; ++axis) (void)Step(axis, 0.0);
    }
    for (std::size_t axis = 0; axis < 4; ++axis) mean_a_[axis] = Copy().Step(axis, 0.0);
  }
  [[nodiscard]] const AxisArray& static_current_a() const { return mean_a_; }

 private:
  [[nodiscard]] Bench Copy() const { return *this; }
  plant::PlantConfig rig_;
  plant::Plant plant_;
  law::LawCoefficients coefficients_;
  law::LawState state_;
  plant::PlantCommand command_;
  AxisArray mean_a_{};
  double limit_a_{};
};

class LoadedRotor : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(LoadedRotor, MeasuresTheSensitivityThatWasComputed) {
  const auto [gravity, speed_rpm] = GetParam();
  const double speed = RpmToRadPerS(speed_rpm);
  configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  const auto controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers);
  rig.plant.gravity_m_per_s2 = gravity;
  rig.plant.unbalance.clear();
  for (auto& bearing : rig.plant.bearings) {
    bearing.amplifier.dac_bits = 0;
    bearing.sensor.adc_bits = 0;
  }
  const auto computed = SensitivityPeaks(rig.plant, controller.law, speed);
  ASSERT_TRUE(computed.stable);
  Bench bench(rig.plant, controller.law);
  bench.Spin(speed);
  bench.Settle();
  for (const std::size_t axis : {0U, 2U}) {
    EXPECT_NEAR(bench.static_current_a()[axis], computed.point.control_a[axis], 1e-3);
    for (const double share : {0.9, 1.0, 1.1}) {
      const double f = share * computed.axes[axis].frequency_hz;
      const double expected = SensitivityAt(rig.plant, controller.law, speed, {f})[0][axis];
      // 2 mA move the rotor by 1 % of the gap: the curvature of the force is its square.
      EXPECT_NEAR(bench.Measure(axis, f), expected, 0.05 * expected)
          << "axis " << axis << " at " << f << " Hz";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(FlexibleRotor, LoadedRotor,
                         testing::Combine(testing::Values(0.0, 9.81, 17.0, 24.0),
                                          testing::Values(0.0, 3000.0, 6000.0)));

}  // namespace
}  // namespace levitas::analysis
