#pragma once
// Work whose lengths differ and whose results belong to an index alone: the longest that is left
// goes to the thread that is free.
//
// Thread, failure  as EachInParallel.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "common/each_in_parallel.hpp"

namespace levitas::diagnosis {

/// work(i) for every index of `lengths`, in any unit.
template <class Work>
void LongestFirst(const std::vector<std::size_t>& lengths, const Work& work) {
  std::vector<std::size_t> order(lengths.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&lengths](std::size_t a, std::size_t b) { return lengths[a] > lengths[b]; });
  EachInParallel(order.size(), 0, [&](std::size_t at) { work(order[at]); });
}

}  // namespace levitas::diagnosis
