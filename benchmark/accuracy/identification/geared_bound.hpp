#pragma once
// Lower bound of the errors of any estimator on the lines of a geared rotor, counted as in
// geared_trial.hpp.
//
// Equation  information I = sum over lines of J' V^-1 J + diag(1/prior^2), errors normal with I^-1
//           (Cramer and Rao; with the priors van Trees 1968). J holds the derivatives of positions
//           and currents by every unknown and by every number that is known to `model_error`; the
//           currents themselves, whose law is not known, are unknown on every line, and leave J by
//           projection. With `model_error`, ks/ki = i0/s0 is known to it too.
// Figures   medians over draws from that distribution, comparable with those of a benchmark.
// Units     relative errors. Thread any, pure.

#include "benchmark/accuracy/identification/geared_trial.hpp"

namespace levitas::accuracy {

/// `plan` needs noise; its seed draws.
[[nodiscard]] GearedErrors BoundOf(const configuration::RigFile& rig, const GearedPlan& plan);

}  // namespace levitas::accuracy
