#pragma once
// The force law that a bearing is configured with. Thread: any; pure.

#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::plant {

[[nodiscard]] inline magnet::Magnet MagnetOf(const MagnetConfig& config) noexcept {
  magnet::Magnet magnet{config.force_constant_n_m2_per_a2, config.gap_m, config.max_coil_current_a};
  if (config.exponential) {
    magnet.decay_m = config.exponential->decay_m;
    magnet.force_n_per_a2 = config.exponential->force_n_per_a2;
    magnet.far_gap_m = config.exponential->far_gap_m;
  }
  return magnet;
}

}  // namespace levitas::plant
