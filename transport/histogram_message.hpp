#pragma once
// The loop's histograms as a message: four fine bins to one (a quarter of an octave, 19 % wide),
// from the first to the last bin that any of the three uses.
//
// Units    nanoseconds. Thread any; allocates. Failure none; without counts there are no bins.

#include <levitas_msg/loop_histogram_t.hpp>

#include "common/histogram.hpp"

namespace levitas::transport {

[[nodiscard]] levitas_msg::loop_histogram_t HistogramMessage(std::uint64_t cycle,
                                                             const Histogram& wakeup,
                                                             const Histogram& compute,
                                                             const Histogram& latency);

}  // namespace levitas::transport
