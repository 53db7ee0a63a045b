#pragma once
// amb bench diagnosis --forecast: healthy rigs fitted at rest and at one speed foretell a run-up.
//
// Trial    by seed: a healthy rig off by its tolerances. Records standing and spinning with test
//          signals are fitted, the run-up is validation data.
// Prints   fit of the run-up by the rig file and by the calibrated model, the interval that was
//          forecast for the latter, and whether it covers; then in how many it covers, in how many
//          the calibrated model is better, and the gain in the median.
// Thread   blocks the caller; `jobs` threads inside.

#include <nlohmann/json_fwd.hpp>

#include "cli/study/bench_trials.hpp"

namespace levitas::cli {

[[nodiscard]] nlohmann::ordered_json RunForecast(const BenchOptions& options,
                                                 const accuracy::TestRig& bench);

}  // namespace levitas::cli
