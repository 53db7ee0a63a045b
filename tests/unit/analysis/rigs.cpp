#include "tests/unit/analysis/rigs.hpp"

#include <cmath>
#include <numbers>

namespace levitas::test {
namespace {

plant::BearingConfig FlexibleBearing(const char* name, double actuator_z_m, double sensor_z_m) {
  plant::BearingConfig bearing;
  bearing.name = name;
  bearing.actuator_z_m = actuator_z_m;
  bearing.sensor_z_m = sensor_z_m;
  const double gap_m = 0.381e-3;
  bearing.magnet = {40.0 * gap_m * gap_m / 4.0, 1.0, gap_m, 2.0};  // ki 40 N/A at 1 A
  bearing.amplifier = {720.0, 0.0, 0};
  bearing.sensor = {5000.0, 1e-6, 14, 400e-6};
  bearing.touchdown = {190e-6, 2e7, 500.0, 0.1, 0.005};
  return bearing;
}

void PositivePolarity(plant::PlantConfig& config) {
  config.sensor_polarity.fill(1.0);
  config.actuator_polarity.fill(1.0);
}

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

plant::PlantConfig FlexibleRotor() {
  plant::PlantConfig config;
  config.period_ns = 100'000;
  config.delay_samples = 1.0;
  config.rotor.material = {193e9, 0.29, 7930.0};
  config.rotor.sections = {{0.4572, 9.525e-3, 0.0}};
  config.rotor.discs = {{0.1299, 0.6363, 1.87e-4, 1.83e-4},
                        {0.2992, 0.8021, 1.65e-4, 2.40e-4},
                        {0.3996, 0.6363, 1.87e-4, 1.83e-4}};
  config.rotor.max_element_length_m = 0.01;
  config.rotor.modes_per_plane = 8;
  config.rotor.modal_damping_ratio = 0.003;
  config.bearings = {FlexibleBearing("de", 0.1299, 0.1099), FlexibleBearing("nde", 0.3996, 0.4196)};
  config.unbalance = {{0.1299, 5e-6, 0.3}, {0.2992, 18e-6, 0.0}, {0.3996, 5e-6, -1.1}};
  config.gravity_m_per_s2 = 9.81;
  config.gravity_direction_rad = -3.0 * std::numbers::pi / 4.0;
  config.substeps = 4;
  PositivePolarity(config);
  return config;
}

law::LawConfig FlexibleRotorLaw() {
  law::LawConfig law;
  for (const double gain : {1.0, 1.0, 2.1294, 2.1294}) law.axes.push_back(FlexibleAxis(gain));
  law.period_s = 1e-4;
  law.current_limit_a = 1.0;
  return law;
}

plant::PlantConfig UfuRig() {
  constexpr double kNodes[] = {0,     .012,  .032,  .052,  .072,  .092,  .112,  .1208, .1272,
                               .1348, .1405, .1469, .1530, .1592, .1654, .1803, .1905, .2063,
                               .2221, .2379, .2537, .2695, .2853, .3011, .3169, .3243, .3363,
                               .3580, .3640, .3705, .3825, .3986, .4147, .4308, .4469, .4630,
                               .4791, .4952, .5113, .5274, .5356, .5457, .5607, .5669, .5731,
                               .5792, .5856, .5913, .5989, .6053, .6141, .6341, .6461};
  struct Run {
    int last;
    double diameter_mm;
  };
  constexpr Run kDiameters[] = {{0, 6.35},  {4, 32.0},   {13, 34.8}, {15, 49.9}, {26, 19.05},
                                {28, 54.0}, {39, 19.05}, {41, 49.9}, {50, 34.8}, {51, 6.35}};
  plant::PlantConfig config;
  config.period_ns = 100'000;
  config.delay_samples = 1.0;
  config.rotor.material = {1.9e11, 0.30, 7850.0};
  int element = 0;
  for (const auto& [last, diameter_mm] : kDiameters) {
    for (; element <= last; ++element) {
      config.rotor.sections.push_back(
          {kNodes[element + 1] - kNodes[element], diameter_mm * 1e-3, 0.0});
    }
  }
  const double disc_width_mm[] = {4, 7, 14};
  for (int i = 0; i < 3; ++i) {
    config.rotor.rings.push_back({kNodes[27 + i], disc_width_mm[i] * 1e-3, 54e-3, 120e-3, 7850.0});
  }
  const double width_mm[] = {8.8, 6.4, 7.5, 5.7, 6.4, 6.1, 6.2, 6.2};
  for (int i = 0; i < 8; ++i) {
    config.rotor.rings.push_back({kNodes[6 + i], width_mm[i] * 1e-3, 34.8e-3, 49.8e-3, 7700.0});
    config.rotor.rings.push_back({kNodes[50 - i], width_mm[i] * 1e-3, 34.8e-3, 49.8e-3, 7700.0});
  }
  config.rotor.max_element_length_m = 0.05;  // longer than any element: nodes as published
  config.rotor.modes_per_plane = 6;
  config.rotor.modal_damping_ratio = 0.003;
  // k = mu0 N^2 A cos(half pole angle) / 4
  const double k = 4e-7 * std::numbers::pi * 138 * 138 * 470.3e-6 * std::cos(0.392) / 4.0;
  for (const int node : {12, 43}) {
    plant::BearingConfig bearing =
        FlexibleBearing(node == 12 ? "a" : "b", kNodes[node], kNodes[node]);
    bearing.magnet = {k, 1.0, 0.432e-3, 2.0};
    config.bearings.push_back(bearing);
  }
  config.substeps = 4;
  PositivePolarity(config);
  return config;
}

plant::PlantConfig RigidCylinder() {
  plant::PlantConfig config;
  config.period_ns = 1'000;
  config.delay_samples = 1.0;
  config.rotor.material = {2e11, 0.3, kCylinderDensity};
  config.rotor.sections = {{kCylinderLength, kCylinderDiameter, 0.0}};
  config.rotor.max_element_length_m = 0.05;
  config.rotor.modes_per_plane = 2;
  const double middle_m = 0.5 * kCylinderLength;
  for (const double z_m : {middle_m - kCylinderArm, middle_m + kCylinderArm}) {
    plant::BearingConfig bearing = FlexibleBearing(z_m < middle_m ? "a" : "b", z_m, z_m);
    bearing.amplifier.bandwidth_hz = 1e5;
    bearing.sensor.bandwidth_hz = 1e5;
    config.bearings.push_back(bearing);
  }
  config.substeps = 1;
  PositivePolarity(config);
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
