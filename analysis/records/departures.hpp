#pragma once
// Ranks the places where a model departs from a record.
// Thread  any; pure.

#include <vector>

#include "analysis/records/innovations.hpp"

namespace levitas::analysis {

/// Orders, bands and windows of all channels beyond kDepartureRatio, the most unexplained
/// power first, in units of the noise of its channel.
[[nodiscard]] std::vector<Departure> Departures(const std::vector<ChannelReport>& channels);

}  // namespace levitas::analysis
