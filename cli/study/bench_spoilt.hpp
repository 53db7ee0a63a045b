#pragma once
// amb bench diagnosis --spoilt: records spoilt on purpose, of which the error must be named, beside
// healthy ones and such with an effect, of which none may be accused.
//
// Kinds    one after the other by seed, or those of --kind: what a seed has made stays the same
//          only with the same list.
// Trial    by seed: `spoilt` with one error each, as many healthy ones, two fifths of that with an
//          effect. Three records each. Named: in one of the three, with its columns and size, and
//          nothing else in any.
// Thread   blocks the caller; `jobs` threads inside.

#include <nlohmann/json_fwd.hpp>

#include "cli/study/bench_trials.hpp"

namespace levitas::cli {

[[nodiscard]] nlohmann::ordered_json RunSpoilt(const BenchOptions& options,
                                               const accuracy::TestRig& bench);

}  // namespace levitas::cli
