#pragma once
// True value of an estimated parameter, in the perturbed rig.
//
// Combined   the hidden effect and what the rig is off by anyway at the same place: ratios
//            multiply, harmonics of one order add as vectors, all else adds.
// Units      those of the parameter. Thread: any; pure.

#include <optional>

#include "benchmark/accuracy/trial.hpp"
#include "diagnosis/report/named_values.hpp"

namespace levitas::accuracy {

/// Nothing where the two cannot be compared: another place, a number that counts from the rig's
/// own.
[[nodiscard]] std::optional<double> TrueValue(const diagnosis::NamedParameter& parameter,
                                              const GroundTruth& ground_truth);

}  // namespace levitas::accuracy
