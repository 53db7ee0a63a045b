#pragma once
// What an import needs to know of a rig whose records hold gaps and duties
// (session/csv_import.hpp).
//
// Thread  any; pure.

#include <vector>

#include "plant_sim/plant/plant_config.hpp"
#include "session/csv_import.hpp"

namespace levitas::analysis {

/// Per axis; a bearing's two axes share its magnet.
[[nodiscard]] inline std::vector<session::CoilScale> CoilScales(const plant::PlantConfig& rig,
                                                                std::size_t axes) {
  std::vector<session::CoilScale> scales;
  scales.reserve(axes);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const plant::MagnetConfig& magnet = rig.bearings[axis / 2].magnet;
    scales.push_back({magnet.gap_m, magnet.max_coil_current_a});
  }
  return scales;
}

}  // namespace levitas::analysis
