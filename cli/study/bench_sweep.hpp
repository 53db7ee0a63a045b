#pragma once
// One of the numbers that decide which answer a diagnosis gives, with several values in turn
// (diagnosis/inference/judging.hpp): the same trials each time.
//
// Prints   how many answers are right with each value: of hidden effects, of several at once, of
//          rigs with nothing hidden, of what is outside the known effects.
// Failure  Problem (exit status 2) for a text that is no NAME=V,V,...; BadInput for a name that is
//          not in the table.

#include <nlohmann/json_fwd.hpp>

#include "cli/study/bench_trials.hpp"

namespace levitas::cli {

/// `options.sweep` is NAME=V,V,...
[[nodiscard]] nlohmann::ordered_json RunSweep(const BenchOptions& options,
                                              const accuracy::TestRig& bench);

}  // namespace levitas::cli
