#include "tests/unit/analysis/laws.hpp"

#include "tests/support/test_rigs.hpp"

namespace levitas::test {
namespace {

law::AxisLawConfig FlexibleAxis(double gain) {
  law::AxisLawConfig axis;
  axis.kp_a_per_m = 4514.47 * gain;
  axis.ki_a_per_m_s = 24128.6 * gain;
  axis.kd_a_s_per_m = 13.0414 * gain;
  axis.derivative_hz = 1868.85;
  axis.lead_lags = {{916.816, 1801.41}};
  axis.notches = {{449.181, 0.6458, 0.8256}, {862.316, 0.2442, 0.8139}};
  return axis;
}

}  // namespace

law::LawConfig FlexibleRotorLaw() {
  law::LawConfig law;
  for (const double gain : {1.0, 1.0, 2.1294, 2.1294}) law.axes.push_back(FlexibleAxis(gain));
  law.period_s = 1e-4;
  law.current_limit_a = 1.0;
  return law;
}

plant::PlantConfig RigidCylinder() {
  plant::PlantConfig config = QuietFlexibleRotor();
  config.period_ns = 1'000;
  config.rotor.material = {2e11, 0.3, kCylinderDensity};
  config.rotor.sections = {{kCylinderLength, kCylinderDiameter, 0.0}};
  config.rotor.discs.clear();
  config.rotor.modes_per_plane = 2;
  config.unbalance.clear();
  double side = -1.0;
  for (auto& bearing : config.bearings) {
    bearing.actuator_z_m = bearing.sensor_z_m = 0.5 * kCylinderLength + side * kCylinderArm;
    bearing.amplifier.bandwidth_hz = 1e5;
    bearing.sensor.bandwidth_hz = 1e5;
    side = 1.0;
  }
  return config;
}

law::LawConfig PdLaw(const plant::PlantConfig& plant, double kp_a_per_m, double kd_a_s_per_m,
                     double derivative_hz) {
  law::LawConfig law;
  law.period_s = static_cast<double>(plant.period_ns) * 1e-9;
  law.current_limit_a = 1.0;
  law::AxisLawConfig axis;
  axis.kp_a_per_m = kp_a_per_m;
  axis.kd_a_s_per_m = kd_a_s_per_m;
  axis.derivative_hz = derivative_hz;
  law.axes.assign(2 * plant.bearings.size(), axis);
  return law;
}

}  // namespace levitas::test
