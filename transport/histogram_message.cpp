#include "transport/histogram_message.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace levitas::transport {
namespace {

constexpr std::size_t kMerge = 4;
constexpr std::size_t kGroups = (Histogram::kBins + kMerge - 1) / kMerge;

std::int32_t CountOf(const Histogram& histogram, std::size_t group) {
  std::uint64_t count = 0;
  const std::size_t end = std::min((group + 1) * kMerge, Histogram::kBins);
  for (std::size_t bin = group * kMerge; bin < end; ++bin) count += histogram.bins()[bin];
  constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::min(count, kMost));
}

}  // namespace

levitas_msg::loop_histogram_t HistogramMessage(std::uint64_t cycle, const Histogram& wakeup,
                                               const Histogram& compute, const Histogram& latency) {
  const std::array<const Histogram*, 3> all{&wakeup, &compute, &latency};
  const auto used = [&all](std::size_t group) {
    return std::any_of(all.begin(), all.end(),
                       [group](const Histogram* h) { return CountOf(*h, group) > 0; });
  };
  std::size_t first = 0;
  while (first < kGroups && !used(first)) ++first;
  std::size_t end = kGroups;
  while (end > first && !used(end - 1)) --end;
  levitas_msg::loop_histogram_t message{};
  message.cycle = static_cast<std::int64_t>(cycle);
  message.bins = static_cast<std::int32_t>(end - first);
  for (auto* row : {&message.wakeup, &message.compute, &message.latency}) row->reserve(end - first);
  message.edge_ns.reserve(end - first);
  for (std::size_t group = first; group < end; ++group) {
    const std::size_t last_bin = std::min((group + 1) * kMerge, Histogram::kBins) - 1;
    message.edge_ns.push_back(static_cast<std::int64_t>(Histogram::UpperEdge(last_bin)));
    message.wakeup.push_back(CountOf(wakeup, group));
    message.compute.push_back(CountOf(compute, group));
    message.latency.push_back(CountOf(latency, group));
  }
  return message;
}

}  // namespace levitas::transport
