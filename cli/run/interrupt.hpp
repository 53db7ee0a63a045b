#pragma once
// Ctrl-C as a count: the first asks for a landing, the second for an end at once.
//
// Signals  SIGINT, SIGTERM and SIGHUP, caught while the guard lives; what is a second request and
//          what the same one again: rt/stop_signal.hpp.
// Thread   one guard at a time, in the main thread.

namespace levitas::cli {

class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// 0: none since the guard was made; 1: land; 2: end at once.
  [[nodiscard]] int count() const noexcept;
  /// Returns after the first.
  void Await() const;
};

}  // namespace levitas::cli
