#pragma once
// Rigs and frames for the tests of the CAN parts.

#include "common/frames.hpp"
#include "common/random.hpp"
#include "common/rig_numbers.hpp"
#include "hil/can/layout.hpp"

namespace levitas::can {

/// As the flexible rotor, with this many axes.
inline RigNumbers TestRig(std::size_t axes = 4) {
  RigNumbers rig;
  rig.name = "test";
  for (std::size_t axis = 0; axis < axes; ++axis) {
    std::string name = "b0_x";
    name[1] = static_cast<char>('0' + axis / 2);
    name[3] = axis % 2 == 0 ? 'x' : 'y';
    rig.channels.push_back(name);
    rig.sensor_polarity[axis] = 1.0;
    rig.actuator_polarity[axis] = 1.0;
  }
  rig.bearings = {"b0", "b1"};
  rig.bias_current_a = 1.0;
  rig.max_coil_current_a = 2.0;
  rig.sensor_range_m = 300e-6;
  rig.max_speed_rad_per_s = 628.0;
  return rig;
}

inline const Message& MessageNamed(const Layout& layout, const std::string& name) {
  for (const Message& message : layout.messages) {
    if (message.name == name) return message;
  }
  throw std::invalid_argument("no message " + name);
}

/// Numbers within the range of every signal.
inline SensorFrame RandomSensorFrame(Random& random, std::size_t axes) {
  SensorFrame frame;
  frame.cycle = random.Bits() % 4096;
  frame.rig_session = static_cast<std::uint32_t>(random.Bits() % 4);
  frame.rig_status = static_cast<std::uint32_t>(random.Bits() % 16);
  frame.axes = static_cast<std::uint32_t>(axes);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    frame.position_m[axis] = (random.Uniform() - 0.5) * 600e-6;
  }
  frame.speed_rad_per_s = (random.Uniform() - 0.5) * 1200.0;
  frame.angle_rad = random.Uniform() * 6.28;
  return frame;
}

inline CurrentFrame RandomCurrentFrame(Random& random, std::size_t axes) {
  CurrentFrame frame;
  frame.cycle = random.Bits() % 4096;
  frame.axes = static_cast<std::uint32_t>(axes);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    frame.control_current_a[axis] = (random.Uniform() - 0.5) * 4.0;
  }
  frame.bias_current_a = random.Uniform() * 2.0;
  frame.speed_set_point_rad_per_s = (random.Uniform() - 0.5) * 1200.0;
  frame.acceleration_limit_rad_per_s2 = random.Uniform() * 1000.0;
  frame.amplifiers_enabled = random.Bits() % 2 == 0;
  frame.drive_enabled = random.Bits() % 2 == 0;
  return frame;
}

}  // namespace levitas::can
