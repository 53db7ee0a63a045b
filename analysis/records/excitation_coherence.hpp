#pragma once
// How much of one channel's innovations follows the recorded test signals, band by band.
// Thread  any; pure.

#include <span>
#include <vector>

#include "analysis/records/innovations.hpp"

namespace levitas::analysis {

/// `edges_hz` are the limits of the bands; empty when no test signal was recorded.
[[nodiscard]] std::vector<ExcitationReport> FollowExcitation(const InnovationRun& run,
                                                             std::size_t channel, std::size_t axes,
                                                             std::span<const double> edges_hz);

}  // namespace levitas::analysis
