#pragma once
// Where a record of a geared rig runs at one speed for long enough to tell its lines apart.
//
// Stretch   rows at one speed (within 0.3 %) for a second or more, the first 0.3 s left out as
//           transient, cut to whole repeats of the engagement.
// Thread    any. Failure none.

#include <cstddef>
#include <vector>

#include "plant_sim/gear/gear_config.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::identification {

/// [s] of one speed that a stretch needs, its transient included.
inline constexpr double kShortestStretchS = 1.3;

struct SteadyStretch {
  std::size_t begin{}, end{};  ///< rows of the record, the end not included
  double speed_rad_per_s{};    ///< mean, of the first shaft
};

/// The rotor's angle [rad] of every row, unwrapped over the whole record.
[[nodiscard]] std::vector<double> UnwrappedAngle(const session::Recording& record);

[[nodiscard]] std::vector<SteadyStretch> SteadyStretches(const session::Recording& record,
                                                         const std::vector<double>& angle,
                                                         const gear::GearPair& pair);

}  // namespace levitas::identification
