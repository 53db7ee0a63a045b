#pragma once
// Lines of a linear geared rotor with ideal PD control, to try the full-spectrum method on.
//
// Truth     geared_lines.hpp, of which nothing is shared with the method.
// Noise     white on every sample of displacement and current, a share of each signal's rms; on a
//           line of a record of N samples it is 1/sqrt(N) of that.
// Errors    every mass, damping, stiffness and inertia that the method takes as known, of bending
//           and of torsion, and the magnets' ks/ki, is off by this share, up or down.
// Units     SI. Thread any. Failure BadInput for a rig that the method refuses.

#include <vector>

#include "benchmark/accuracy/identification/geared_lines.hpp"

namespace levitas::accuracy {

struct GearedTrial {
  std::vector<identification::GearedLine> lines;
  identification::GearedKnown known;  ///< with its errors
};

[[nodiscard]] GearedTrial MakeGearedTrial(const configuration::RigFile& rig,
                                          const GearedPlan& plan);

/// Largest relative errors; phases count, as |found - true| / |true|.
struct GearedErrors {
  double mesh_stiffness{}, mesh_damping{};
  double ks{}, ki{}, run_out{};  ///< of the worse shaft
  double net_stiffness{};        ///< shaft stiffness minus ks, all that a line can tell
  double mean_error{};           ///< of the transmission error, what can be told of it
  double varying_error{};        ///< median over the harmonics
};

[[nodiscard]] GearedErrors Compare(const configuration::RigFile& rig,
                                   const identification::GearedParameters& found);

}  // namespace levitas::accuracy
