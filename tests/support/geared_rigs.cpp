#include "tests/support/geared_rigs.hpp"

#include "plant_sim/rotor/lumped_shaft.hpp"

namespace levitas::test {
namespace {

plant::BearingConfig GearBearing(const char* name, std::size_t shaft, double z_m) {
  plant::BearingConfig b;
  b.name = name;
  b.shaft = shaft;
  b.actuator_z_m = z_m;
  b.sensor_z_m = z_m;
  // k = ki s0^2 / (4 i0) with ki = 80 N/A
  b.magnet = {80.0 * 0.8e-3 * 0.8e-3 / 4.0, 1.0, 0.8e-3, 2.0};
  b.amplifier = {2000.0, 0.0, 0};
  b.sensor.bandwidth_hz = 5000.0;
  b.sensor.range_m = 500e-6;
  return b;
}

gear::GearPair Pair() {
  gear::GearPair pair;
  pair.name = "mesh";
  pair.driving = {0, 0.0, 20, 37.6e-3, 20e-6, 0.6, 2.0};
  // Run-out exp(-j (w t - 0.9)): the wheel turns backwards, its vector stands at +0.9 rad.
  pair.driven = {1, 0.0, 40, 75.2e-3, 30e-6, 0.9, 3.5};
  pair.stiffness_n_per_m = 1e6;
  pair.damping_n_s_per_m = 300.0;
  pair.pressure_angle_rad = 20.0 * std::numbers::pi / 180.0;
  pair.transmission_error = {{0, 10e-6, 0.3},  {1, 5e-6, 0.8},  {-1, 3e-6, -1.1}, {2, 6e-6, 1.9},
                             {-2, 4e-6, 0.2},  {3, 6e-6, -0.7}, {-3, 4e-6, 2.4},  {4, 8e-6, 1.2},
                             {-4, 5e-6, -2.0}, {5, 8e-6, 0.1},  {-5, 5e-6, -0.4}};
  return pair;
}

rotor::Shaft Lumped(const char* name, double mass_kg, double stiffness_n_per_m, double damping) {
  rotor::Shaft shaft;
  shaft.name = name;
  shaft.lumped.mass_kg = mass_kg;
  shaft.lumped.kll_n_per_m = stiffness_n_per_m;
  shaft.lumped.damping_n_s_per_m = damping;
  return shaft;
}

void AddTilt(rotor::Shaft& shaft, double bending_stiffness_n_m2, double diametral, double polar) {
  shaft.lumped.z_m = 0.2;
  shaft.lumped.diametral_inertia_kg_m2 = diametral;
  shaft.lumped.polar_inertia_kg_m2 = polar;
  rotor::SetSimplySupported(shaft.lumped, 0.5, bending_stiffness_n_m2);
}

rotor::Support Bearings(double z_m, double kx, double ky) { return {z_m, kx, ky, 3e3, 3e3}; }

rotor::Shaft Beam(const char* name) {
  rotor::Shaft shaft;
  shaft.name = name;
  shaft.is_beam = true;
  // G = 79.5 GPa: E/(2 G) - 1
  shaft.beam.material = {207e9, 207.0 / (2.0 * 79.5) - 1.0, 7800.0};
  // One element per section, as the publication has them: its frequencies are those of that mesh.
  shaft.beam.max_element_length_m = 5.0;
  shaft.torsion.kind = rotor::TorsionKind::kBeam;
  return shaft;
}

}  // namespace

plant::PlantConfig GearedRotor4() {
  plant::PlantConfig c;
  c.period_ns = 100'000;
  c.delay_samples = 1.0;
  c.substeps = 4;
  c.shafts = {Lumped("pinion", 2.0, 2.0e5, 60.0), Lumped("gear", 3.5, 2.4e5, 80.0)};
  c.gears = {Pair()};
  c.bearings = {GearBearing("p", 0, 0.0), GearBearing("g", 1, 0.0)};
  c.drive = {100.0, 0.02, 2.0};
  c.sensor_polarity = {1.0, 1.0, 1.0, 1.0};
  c.actuator_polarity = {1.0, 1.0, 1.0, 1.0};
  return c;
}

plant::PlantConfig GearedRotor8() {
  plant::PlantConfig c = GearedRotor4();
  AddTilt(c.shafts[0], 480.0, 1.8e-3, 3.4e-3);
  AddTilt(c.shafts[1], 576.0, 6.0e-3, 1.15e-2);
  c.gears[0].driving.z_m = c.gears[0].driven.z_m = 0.2;
  for (auto& b : c.bearings) b.actuator_z_m = b.sensor_z_m = 0.2;
  return c;
}

plant::PlantConfig GearedRotor12() {
  plant::PlantConfig c = GearedRotor8();
  // 13 N m/rad and 0.6 N m s/rad: a drive that holds its angle with 5 Hz, damped 0.7.
  c.shafts[0].torsion = {rotor::TorsionKind::kInertias,
                         {{"motor", 5.0e-3, 1.83e3, 13.0, 0.6}, {"pinion", 3.4e-3, 0.0, 0.0, 0.0}},
                         1,
                         0.01,
                         {}};
  c.shafts[1].torsion = {rotor::TorsionKind::kInertias,
                         {{"gear", 1.15e-2, 1.47e3, 0.0, 0.0}, {"brake", 8.0e-3, 0.0, 0.0, 0.0}},
                         0,
                         0.01,
                         {}};
  c.gears[0].driving_torque_n_m = 5.0;
  return c;
}

plant::PlantConfig RaoPair() {
  plant::PlantConfig c;
  c.period_ns = 100'000;
  c.substeps = 4;
  c.drive = {100.0, 0.02, 2.0};
  rotor::Shaft first = Beam("gear");
  first.beam.sections = {{0.1, 0.3, 0.0}, {4.24, 0.3, 0.0}, {1.16, 0.22, 0.0}, {0.3, 0.22, 0.0}};
  first.beam.discs = {
      {0.1, 525.7, 16.1, 32.2}, {4.34, 116.04, 3.115, 6.23}, {5.8, 726.4, 56.95, 113.9}};
  first.supports = {Bearings(0.0, 183.9e6, 200.4e6), Bearings(5.5, 183.9e6, 200.4e6)};
  rotor::Shaft second = Beam("pinion");
  second.beam.sections = {{0.3, 0.15, 0.0}, {5.0, 0.15, 0.0}, {0.1, 0.15, 0.0}};
  second.beam.discs = {{0.0, 5.0, 0.002, 0.004}, {5.3, 7.45, 0.0745, 0.149}};
  second.supports = {Bearings(0.3, 10.1e6, 41.6e6), Bearings(5.4, 10.1e6, 41.6e6)};
  c.shafts = {first, second};
  gear::GearPair pair;
  pair.name = "mesh";
  pair.driving = {0, 5.8, 328, 0.5086, 0.0, 0.0, 0.0};
  pair.driven = {1, 0.0, 23, 0.03567, 0.0, 0.0, 0.0};
  pair.stiffness_n_per_m = 1e8;
  pair.pressure_angle_rad = 22.5 * std::numbers::pi / 180.0;
  pair.direction = gear::Direction::kLineOfAction;
  c.gears = {pair};
  return c;
}

}  // namespace levitas::test
