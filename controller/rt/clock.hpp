#pragma once
// Time as the loops see it: CLOCK_MONOTONIC, or a test's own.
//
// Units    nanoseconds.
// Waiting  MonotonicClock sleeps until 25 us before the instant and spins for the rest. The sleep's
//          wake-up error (13 us median, docs/timing.md) disappears in the spin; a spin over the
//          whole period would be stopped by the kernel's real-time throttling.
// Thread   any; no allocation, no failure.

#include <cstdint>

namespace levitas::rt {

class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual std::int64_t NowNs() noexcept = 0;
  /// Returns at `due_ns` or as soon after it as the machine allows.
  virtual void SleepUntil(std::int64_t due_ns) noexcept = 0;
};

class MonotonicClock final : public Clock {
 public:
  static constexpr std::int64_t kSpinNs = 25'000;

  /// `spin_ns` 0 gives a plain sleep.
  explicit MonotonicClock(std::int64_t spin_ns = kSpinNs) noexcept : spin_ns_(spin_ns) {}
  [[nodiscard]] std::int64_t NowNs() noexcept override;
  void SleepUntil(std::int64_t due_ns) noexcept override;

 private:
  std::int64_t spin_ns_;
};

/// CLOCK_MONOTONIC now [ns].
[[nodiscard]] std::int64_t MonotonicNowNs() noexcept;

}  // namespace levitas::rt
