#pragma once
// Work shared by two threads. Results do not depend on timing.
//
// ParallelFor    an index is always done by the same thread, so that sums kept by each thread are
//                the same in every run.
// LongestFirst   for work whose lengths differ and whose results belong to an index alone: the
//                longest that is left goes to the thread that is free.
// Thread  blocks the caller, which is one of the two. Failure: what `work` throws ends the program.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <numeric>
#include <thread>
#include <vector>

namespace levitas::diagnosis {

inline constexpr std::size_t kThreads = 2;

/// work(i, thread) for every i below `count`; thread t does t, t + 2, ...
template <class Work>
void ParallelFor(std::size_t count, const Work& work) {
  const auto share = [&work, count](std::size_t thread) {
    for (std::size_t i = thread; i < count; i += kThreads) work(i, thread);
  };
  std::thread other(share, 1);
  share(0);
  other.join();
}

/// work(i) for every index of `lengths`, in any unit.
template <class Work>
void LongestFirst(const std::vector<std::size_t>& lengths, const Work& work) {
  std::vector<std::size_t> order(lengths.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&lengths](std::size_t a, std::size_t b) { return lengths[a] > lengths[b]; });
  std::atomic<std::size_t> next{0};
  const auto share = [&] {
    for (std::size_t at = next++; at < order.size(); at = next++) work(order[at]);
  };
  if (lengths.size() < 2) return share();
  std::thread other(share);
  share();
  other.join();
}

}  // namespace levitas::diagnosis
