#pragma once
// Gap and full current of each coil, for records that hold gaps and duties (measured_data.hpp).
//
// Source  magnet of the bearing: gap with the rotor centred [m], largest coil current [A].
// Thread  any; pure.

#include <cstddef>
#include <vector>

#include "plant_sim/plant/plant_config.hpp"
#include "session/exchange/measured_data.hpp"

namespace levitas::session {

/// Per axis; a bearing's two axes share its magnet.
[[nodiscard]] inline std::vector<CoilScale> CoilScales(const plant::PlantConfig& rig,
                                                       std::size_t axes) {
  std::vector<CoilScale> scales;
  scales.reserve(axes);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const plant::MagnetConfig& magnet = rig.bearings[axis / 2].magnet;
    scales.push_back({magnet.gap_m, magnet.max_coil_current_a});
  }
  return scales;
}

}  // namespace levitas::session
