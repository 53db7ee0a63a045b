#include "tests/support/test_rigs.hpp"

#include <array>
#include <numbers>

#include "plant_sim/magnet/magnet.hpp"

namespace levitas::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

plant::BearingConfig Bearing(const char* name, double actuator_z_m, double sensor_z_m) {
  plant::BearingConfig b;
  b.name = name;
  b.actuator_z_m = actuator_z_m;
  b.sensor_z_m = sensor_z_m;
  // k = ki s0^2 / (4 i0) with ki = 40 N/A
  b.magnet = {40.0 * 0.381e-3 * 0.381e-3 / 4.0, 1.0, 0.381e-3, 2.0};
  b.amplifier = {720.0, 0.0, 0};
  b.sensor.bandwidth_hz = 5000.0;
  b.sensor.range_m = 400e-6;
  return b;
}

}  // namespace

plant::PlantConfig QuietFlexibleRotor() {
  plant::PlantConfig c;
  c.period_ns = 100'000;
  c.delay_samples = 1.0;
  c.rotor.material = {193e9, 0.29, 7930.0};
  c.rotor.sections = {{0.4572, 9.525e-3, 0.0}};
  c.rotor.discs = {{0.1299, 0.6363, 1.87e-4, 1.83e-4},
                   {0.2992, 0.8021, 1.65e-4, 2.40e-4},
                   {0.3996, 0.6363, 1.87e-4, 1.83e-4}};
  c.rotor.max_element_length_m = 0.02;
  c.rotor.modes_per_plane = 8;
  c.rotor.modal_damping_ratio = 0.003;
  c.bearings = {Bearing("de", 0.1299, 0.1099), Bearing("nde", 0.3996, 0.4196)};
  c.unbalance = {{0.1299, 5e-6, 0.3}, {0.2992, 18e-6, 0.0}, {0.3996, 5e-6, -1.1}};
  c.gravity_direction_rad = 225.0 * kDegree;
  c.drive = {1000.0, 0.05, 2.0};
  c.sensor_polarity = {1.0, 1.0, 1.0, 1.0};
  c.actuator_polarity = {1.0, 1.0, 1.0, 1.0};
  c.substeps = 4;
  return c;
}

plant::PlantConfig FlexibleRotor() {
  plant::PlantConfig c = QuietFlexibleRotor();
  c.gravity_m_per_s2 = 9.81;
  for (auto& b : c.bearings) {
    b.amplifier.dac_bits = 16;
    b.sensor.noise_rms_m = 1e-6;
    b.sensor.adc_bits = 14;
    b.touchdown = {190e-6, 2e7, 2000.0, 0.15, 0.012};
  }
  return c;
}

plant::PlantConfig UfuRig() {
  constexpr std::array kNodes{0.0,   .012,  .032,  .052,  .072,  .092,  .112,  .1208, .1272,
                              .1348, .1405, .1469, .1530, .1592, .1654, .1803, .1905, .2063,
                              .2221, .2379, .2537, .2695, .2853, .3011, .3169, .3243, .3363,
                              .3580, .3640, .3705, .3825, .3986, .4147, .4308, .4469, .4630,
                              .4791, .4952, .5113, .5274, .5356, .5457, .5607, .5669, .5731,
                              .5792, .5856, .5913, .5989, .6053, .6141, .6341, .6461};
  struct Range {
    std::size_t last;
    double diameter_m;
  };
  constexpr std::array kDiameters{Range{0, 6.35e-3},   Range{4, 32e-3},     Range{13, 34.8e-3},
                                  Range{15, 49.9e-3},  Range{26, 19.05e-3}, Range{28, 54e-3},
                                  Range{39, 19.05e-3}, Range{41, 49.9e-3},  Range{50, 34.8e-3},
                                  Range{51, 6.35e-3}};
  plant::PlantConfig c = QuietFlexibleRotor();
  c.rotor = {};
  c.rotor.material = {1.9e11, 0.30, 7850.0};
  std::size_t range = 0;
  for (std::size_t i = 0; i + 1 < kNodes.size(); ++i) {
    if (i > kDiameters[range].last) ++range;
    c.rotor.sections.push_back({kNodes[i + 1] - kNodes[i], kDiameters[range].diameter_m, 0.0});
  }
  constexpr std::array kDiscWidths{4e-3, 7e-3, 14e-3};
  for (std::size_t i = 0; i < 3; ++i) {
    c.rotor.rings.push_back({kNodes[27 + i], kDiscWidths[i], 54e-3, 120e-3, 7850.0});
  }
  constexpr std::array kWidths{8.8e-3, 6.4e-3, 7.5e-3, 5.7e-3, 6.4e-3, 6.1e-3, 6.2e-3, 6.2e-3};
  for (std::size_t i = 0; i < 8; ++i) {
    c.rotor.rings.push_back({kNodes[6 + i], kWidths[i], 34.8e-3, 49.8e-3, 7700.0});
    c.rotor.rings.push_back({kNodes[43 + i], kWidths[7 - i], 34.8e-3, 49.8e-3, 7700.0});
  }
  c.rotor.max_element_length_m = 1.0;
  c.rotor.modes_per_plane = 8;
  c.rotor.modal_damping_ratio = 0.001;
  c.unbalance.clear();
  c.bearings = {Bearing("de", kNodes[12], kNodes[12]), Bearing("nde", kNodes[43], kNodes[43])};
  for (auto& b : c.bearings) {
    // The source's formula, mu0 N^2 A cos(a)/4, with the gap as it is (config/rigs/ufu_rig.yaml).
    b.magnet = {2.600303281978716e-6, 1.0, 0.432e-3, 2.0};
  }
  return c;
}

plant::PlantConfig RigidRotor(double mass_kg) {
  plant::PlantConfig c = QuietFlexibleRotor();
  // A short thick shaft of almost no mass carries two equal discs at its bearings: with two modes
  // kept it is exactly a rigid body.
  c.rotor.material = {2.1e11, 0.3, 1e-6};
  c.rotor.sections = {{0.2, 0.04, 0.0}};
  c.rotor.discs = {{0.05, mass_kg / 2.0, 0.0, 0.0}, {0.15, mass_kg / 2.0, 0.0, 0.0}};
  c.rotor.max_element_length_m = 0.05;
  c.rotor.modes_per_plane = 2;
  c.rotor.modal_damping_ratio = 0.0;
  c.unbalance.clear();
  c.bearings = {Bearing("left", 0.05, 0.05), Bearing("right", 0.15, 0.15)};
  return c;
}

}  // namespace levitas::test
