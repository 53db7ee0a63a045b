#pragma once
// A small rig and batches of samples for the tests of this folder.

#include <functional>
#include <levitas_msg/sample_batch_t.hpp>

#include "common/rig_numbers.hpp"

namespace levitas::dashboard {

/// Two axes of one bearing; 10 kHz.
inline RigNumbers SmallRig() {
  RigNumbers rig;
  rig.name = "small";
  rig.channels = {"de_x", "de_y"};
  rig.bearings = {"de"};
  rig.period_ns = 100'000;
  rig.clearance_m = 200e-6;
  rig.sensor_polarity.fill(1.0);
  rig.actuator_polarity.fill(1.0);
  return rig;
}

/// `position(cycle, axis)` [m]; currents are a thousand times that [A], the speed is 100 rad/s.
inline levitas_msg::sample_batch_t Batch(std::int64_t first_cycle, std::int32_t samples,
                                         const std::function<double(std::int64_t, int)>& position) {
  levitas_msg::sample_batch_t batch{};
  batch.first_cycle = first_cycle;
  batch.last_time_ns = (first_cycle + samples - 1) * 100'000;
  batch.axes = 2;
  batch.samples = samples;
  batch.values = 2 * samples;
  for (std::int64_t cycle = first_cycle; cycle < first_cycle + samples; ++cycle) {
    for (int axis = 0; axis < 2; ++axis) {
      batch.position_m.push_back(static_cast<float>(position(cycle, axis)));
      batch.control_current_a.push_back(static_cast<float>(1000.0 * position(cycle, axis)));
    }
    batch.speed_rad_per_s.push_back(100.0F);
    batch.angle_rad.push_back(0.0F);
  }
  return batch;
}

}  // namespace levitas::dashboard
