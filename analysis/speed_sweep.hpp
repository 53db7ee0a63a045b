#pragma once
// Sensitivity over a range of speeds: gyroscopic forces move the modes, and the worst may lie
// between standstill and the top.
//
// Speeds    nine, evenly spaced, both ends among them; then golden section between the neighbours
//           of the worst, until its place is known to 1 % of the range. What is narrower than an
//           eighth of the range may be missed.
// Worst     an unstable loop before any peak; then the largest max |S_ii|.
// Thread    any. Failure: BadInput when the law's axes do not fit the plant's.

#include <vector>

#include "analysis/sensitivity.hpp"

namespace levitas::analysis {

struct SpeedSweep {
  std::vector<SensitivityResult> speeds;  ///< ascending: both ends, and the worst if it is between
  std::size_t worst{};                    ///< which of them
};

/// From standstill to `top_speed_rad_per_s`; 0: standstill alone.
[[nodiscard]] SpeedSweep SensitivityOverSpeed(const plant::PlantConfig& plant,
                                              const law::LawConfig& law,
                                              double top_speed_rad_per_s);

/// Axis with the largest peak.
[[nodiscard]] std::size_t WorstAxis(const SensitivityResult& result) noexcept;

}  // namespace levitas::analysis
