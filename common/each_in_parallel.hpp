#pragma once
// The same work for every index, by as many threads as the machine has processors.
//
// Result  what belongs to an index alone is the same however many threads there are; which thread
//         does which index is not said.
// Thread  blocks the caller, which is one of them. Failure: what `work` throws ends the program.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace levitas {

/// work(i) for every i below `count`, the lower ones begun first. `threads` 0: the machine's.
template <class Work>
void EachInParallel(std::size_t count, std::size_t threads, const Work& work) {
  const std::size_t processors = std::max<std::size_t>(1, std::thread::hardware_concurrency());
  const std::size_t used = std::min(threads == 0 ? processors : threads, count);
  std::atomic<std::size_t> next{0};
  const auto share = [&next, &work, count] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> others;
  for (std::size_t t = 1; t < used; ++t) others.emplace_back(share);
  share();
}

}  // namespace levitas
