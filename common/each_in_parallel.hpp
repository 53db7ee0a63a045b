#pragma once
// The same work for every index, by as many threads as this process may use processors.
//
// Result  what belongs to an index alone is the same however many threads there are; which thread
//         does which index is not said. A sum whose rounding must not depend on their number is
//         kept per index, in a number of parts that is a constant.
// Number  the processors that the process may run on (`taskset -c 0` makes it one), or
//         LEVITAS_THREADS where that is set.
// Thread  blocks the caller, which is one of them. Failure: what `work` throws ends the program,
//         except in EachThatMayFail.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace levitas {

/// At least 1. Failure: a Problem of status 2 where LEVITAS_THREADS is no number from 1 to 1024.
[[nodiscard]] std::size_t Processors();

/// work(i) for every i below `count`, the lower ones begun first. `threads` 0: Processors().
template <class Work>
void EachInParallel(std::size_t count, std::size_t threads, const Work& work) {
  const std::size_t used = std::min(threads == 0 ? Processors() : threads, count);
  std::atomic<std::size_t> next{0};
  const auto share = [&next, &work, count] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> others;
  for (std::size_t t = 1; t < used; ++t) others.emplace_back(share);
  share();
}

/// The same; what the work of the lowest index throws is thrown when all is done.
template <class Work>
void EachThatMayFail(std::size_t count, std::size_t threads, const Work& work) {
  std::vector<std::exception_ptr> failures(count);
  EachInParallel(count, threads, [&](std::size_t i) {
    try {
      work(i);
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace levitas
