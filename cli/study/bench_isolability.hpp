#pragma once
// `amb bench diagnosis --isolability`: what is foretold of every trial, against what the diagnosis
// answers.
//
// Foretold  from the records of the same rig, loop and seed with nothing hidden, calibrated, and
//           the hidden effect at its true size. The diagnosis sees the records with it.
// Answers   of a diagnosis made here, or of an earlier run's --json (`answered`), which must be of
//           the same trials.
// Thread    blocks the caller; `jobs` threads inside.
// Failure   BadInput for answers of other trials.

#include <nlohmann/json_fwd.hpp>

#include "cli/study/bench_trials.hpp"

namespace levitas::cli {

[[nodiscard]] nlohmann::ordered_json RunIsolability(const BenchOptions& options,
                                                    const accuracy::TestRig& bench);

}  // namespace levitas::cli
