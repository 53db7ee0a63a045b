#pragma once
// Waiting in tests: for what is about to be judged, with one limit for all.
//
// No test may depend on how busy the machine is. A passing test never waits for kLimit; a sleep
// that stands for "by now it will have happened" is refused by tests/build/waiting.

#include <chrono>
#include <thread>

namespace levitas::test {

/// Far above any delay of a busy machine; under a sanitizer everything takes several times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::chrono::minutes kLimit{40};
#else
inline constexpr std::chrono::minutes kLimit{10};
#endif

/// True as soon as `what()` is; false when it is not within kLimit.
template <class What>
[[nodiscard]] bool Eventually(What what) {
  const auto end = std::chrono::steady_clock::now() + kLimit;
  while (!what()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// Lets time pass on purpose: the reason says why a machine that makes it longer changes nothing.
inline void Pause(std::chrono::nanoseconds duration, const char* /*reason*/) {
  std::this_thread::sleep_for(duration);
}

}  // namespace levitas::test
