#include "tests/loop/physics/random_plant.hpp"

#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/unit/rotor/random_rotor.hpp"

namespace levitas::plant {

PlantConfig RandomPlant(std::uint64_t seed) {
  Random random(seed + 1000);
  const auto between = [&random](double a, double b) { return a + (b - a) * random.Uniform(); };
  PlantConfig c;
  c.period_ns = 100'000;
  c.delay_samples = between(0.0, 2.0);
  c.rotor = rotor::RandomRotor(seed);
  c.rotor.modes_per_plane = 6 + random.Bits() % 4;
  double length_m = 0.0;
  for (const auto& section : c.rotor.sections) length_m += section.length_m;
  for (const double place : {0.2, 0.8}) {
    BearingConfig b;
    b.name = place < 0.5 ? "de" : "nde";
    b.actuator_z_m = length_m * (place + between(-0.1, 0.1));
    b.sensor_z_m = b.actuator_z_m + length_m * between(-0.05, 0.05);
    b.magnet = {between(0.5e-6, 2e-6), 1.0, between(0.35e-3, 0.5e-3), 2.0};
    b.amplifier.bandwidth_hz = between(500.0, 2000.0);
    b.sensor.bandwidth_hz = between(2000.0, 10000.0);
    b.sensor.gain = between(0.9, 1.1);
    b.touchdown = {190e-6, 2e7, 2000.0, 0.15, 0.012};
    c.bearings.push_back(b);
  }
  c.unbalance = {{length_m * random.Uniform(), between(0.0, 2e-5), between(-3.0, 3.0)},
                 {length_m * random.Uniform(), between(0.0, 2e-5), between(-3.0, 3.0)}};
  c.gravity_m_per_s2 = 9.81;
  c.gravity_direction_rad = between(0.0, 2.0 * std::numbers::pi);
  c.drive = {1000.0, 0.05, 2.0};
  for (std::size_t axis = 0; axis < 4; ++axis) {
    c.sensor_polarity[axis] = random.Uniform() < 0.5 ? -1.0 : 1.0;
    c.actuator_polarity[axis] = random.Uniform() < 0.5 ? -1.0 : 1.0;
  }
  c.substeps = 4;
  return c;
}

PlantConfig RandomFreeRotor(std::uint64_t seed) {
  PlantConfig c = RandomPlant(seed);
  c.rotor.modal_damping_ratio = 0.0;
  c.unbalance.clear();
  c.gravity_m_per_s2 = 0.0;
  for (auto& b : c.bearings) b.touchdown = {};
  return c;
}

PlantCommand HeldSpeed(double speed_rad_per_s) {
  PlantCommand command;
  command.amplifiers_enabled = false;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = speed_rad_per_s;
  command.acceleration_limit_rad_per_s2 = 1000.0;
  return command;
}

PlantCommand Wave(int step, double amplitude_a, double speed_rad_per_s) {
  PlantCommand command = HeldSpeed(speed_rad_per_s);
  command.amplifiers_enabled = true;
  command.bias_current_a = 1.0;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    command.control_current_a[axis] =
        amplitude_a * std::sin(0.37 * step + 1.7 * static_cast<double>(axis));
  }
  return command;
}

void Kick(Plant& plant, std::uint64_t seed) {
  Random random(seed + 2000);
  const auto& at = plant.layout();
  for (std::size_t i = 0; i < at.modes; ++i) {
    plant.mutable_state()[at.v_x + i] = 0.02 * random.Normal();
    plant.mutable_state()[at.v_y + i] = 0.02 * random.Normal();
  }
}

double Energy(const Plant& plant) {
  const auto& at = plant.layout();
  const auto& modes = plant.model().parameters().modes;
  double sum = 0.0;
  for (std::size_t i = 0; i < at.modes; ++i) {
    const double w = modes.frequency_rad_per_s[static_cast<Eigen::Index>(i)];
    for (const auto& [q, v] : {std::pair{at.q_x, at.v_x}, std::pair{at.q_y, at.v_y}}) {
      sum += 0.5 * std::pow(w * plant.state()[q + i], 2) + 0.5 * std::pow(plant.state()[v + i], 2);
    }
  }
  return sum;
}

}  // namespace levitas::plant
