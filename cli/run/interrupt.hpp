#pragma once
// Ctrl-C as a count: the first asks for a landing, the second for an end at once.
//
// Signals  SIGINT, SIGTERM and SIGHUP, caught while the guard lives; the handler only counts.
// Thread   one guard at a time, in the main thread.

namespace levitas::cli {

class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Signals caught since the guard was made.
  [[nodiscard]] int count() const noexcept;
};

}  // namespace levitas::cli
