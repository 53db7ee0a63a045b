#pragma once
// The coils on a voltage that a bearing is configured with: towards +x, and away from it.
// Thread: any; pure.

#include <array>

#include "plant_sim/amplifier/voltage_coil.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::plant {

/// Coils of current loops when the bearing has those.
[[nodiscard]] inline std::array<amplifier::VoltageCoil, 2> CoilsOf(
    const BearingConfig& bearing) noexcept {
  if (!bearing.amplifier.voltage) return {};
  const VoltageDrive& v = *bearing.amplifier.voltage;
  const amplifier::VoltageCoil towards{
      v.steady,       v.offset_a,    v.time_constant_s, v.decay_m,
      v.motion_emf,   v.dead_band_a, v.curvature,       bearing.magnet.max_coil_current_a,
      v.iron_1_per_a2};
  amplifier::VoltageCoil away = towards;
  away.steady *= v.away_steady_ratio;
  away.time_constant_s *= v.away_time_constant_ratio;
  return {towards, away};
}

}  // namespace levitas::plant
