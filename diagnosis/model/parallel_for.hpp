#pragma once
// Work shared by two threads, always in the same way: results do not depend on timing.
//
// Thread  blocks the caller, which is one of the two. Failure: what `work` throws ends the program.

#include <cstddef>
#include <thread>

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

}  // namespace levitas::diagnosis
