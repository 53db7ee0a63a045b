#pragma once
// Innovations of a run side by side: a moment is a kilobyte, of which sums need four bytes.
//
// Thread  plain data.

#include <cstdint>
#include <vector>

#include "diagnosis/model/model_run.hpp"

namespace levitas::diagnosis {

/// 1 where a sample counts.
[[nodiscard]] inline std::vector<std::uint8_t> Counting(const Trajectory& run) {
  std::vector<std::uint8_t> counts;
  counts.reserve(run.moments.size());
  for (const SamplePoint& m : run.moments) counts.push_back(m.counts ? 1 : 0);
  return counts;
}

/// [m] of one axis, behind `history` zeros.
[[nodiscard]] inline std::vector<double> InnovationSeries(const Trajectory& run, std::size_t axis,
                                                          std::size_t history) {
  std::vector<double> values(history, 0.0);
  values.reserve(history + run.moments.size());
  for (const SamplePoint& m : run.moments) {
    values.push_back(static_cast<double>(m.innovation_m[axis]));
  }
  return values;
}

}  // namespace levitas::diagnosis
