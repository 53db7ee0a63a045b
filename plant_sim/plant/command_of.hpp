#pragma once
// What a message of currents asks of the plant: the same quantities in SI, none left out.
// Thread   any; pure.

#include "common/frames.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::plant {

[[nodiscard]] inline PlantCommand CommandOf(const CurrentFrame& current) noexcept {
  return {.control_current_a = current.control_current_a,
          .bias_current_a = current.bias_current_a,
          .amplifiers_enabled = current.amplifiers_enabled,
          .drive_enabled = current.drive_enabled,
          .speed_set_point_rad_per_s = current.speed_set_point_rad_per_s,
          .acceleration_limit_rad_per_s2 = current.acceleration_limit_rad_per_s2};
}

}  // namespace levitas::plant
