#pragma once
// Trials of a benchmark, several at a time: work(i) once for every i below `count`, the next one by
// whichever thread is free.
//
// Thread   blocks the caller, which is one of `jobs`. `work` keeps apart what it shares.
// Failure  what `work` throws is thrown here, when the trials that had begun have ended; no other
//          one is begun.

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace levitas::cli {

template <class Work>
void ForEachTrial(std::size_t count, std::size_t jobs, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::mutex failing;
  std::exception_ptr failure;
  const auto turn = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      const std::lock_guard lock(failing);
      failure = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> others;
  for (std::size_t job = 1; job < jobs; ++job) others.emplace_back(turn);
  turn();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace levitas::cli
