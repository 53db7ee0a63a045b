#pragma once
// Motion of a geared rig in tests: complex displacements of both shafts, and their lines.

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "plant_sim/plant/plant.hpp"

namespace levitas::test {

using Complex = std::complex<double>;

struct Whirl {
  Complex pinion;
  Complex gear;
};

inline Whirl At(const plant::Plant& plant) {
  const AxisArray m = plant.ActuatorPosition();
  return {{m[0], m[1]}, {m[2], m[3]}};
}

/// Component of a record at a signed frequency: positive is forward whirl.
inline Whirl Line(const std::vector<Whirl>& record, double period_s, double frequency_hz) {
  Whirl sum;
  const Complex step = std::polar(1.0, -2.0 * std::numbers::pi * frequency_hz * period_s);
  Complex turned = 1.0;
  for (const Whirl& r : record) {
    sum.pinion += r.pinion * turned;
    sum.gear += r.gear * turned;
    turned *= step;
  }
  const auto count = static_cast<double>(record.size());
  return {sum.pinion / count, sum.gear / count};
}

/// A command with the amplifiers off: the shafts stand on their own springs alone.
inline plant::PlantCommand Passive(double speed_rad_per_s) {
  plant::PlantCommand command;
  command.amplifiers_enabled = false;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = speed_rad_per_s;
  command.acceleration_limit_rad_per_s2 = 1e9;
  return command;
}

}  // namespace levitas::test
