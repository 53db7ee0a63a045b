#pragma once
// Time as the loops see it: CLOCK_MONOTONIC, or a test's own.
//
// Units    nanoseconds.
// Waiting  MonotonicClock sleeps until 25 to 60 us before the instant (spin_margin.hpp) and spins
//          for the rest. The sleep's wake-up error (13 us median on a quiet machine,
//          docs/timing.md) disappears in the spin; a spin over the whole period would be stopped
//          by the kernel's real-time throttling.
// Alone    on a machine with one processor nothing spins: it would keep everybody else, the rig's
//          simulation among them, from what is being waited for.
// Thread   one per object; no allocation, no failure.

#include <cstdint>

#include "rt/spin_margin.hpp"

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
  [[nodiscard]] std::int64_t NowNs() noexcept override;
  void SleepUntil(std::int64_t due_ns) noexcept override;

 private:
  SpinMargin margin_;
};

/// CLOCK_MONOTONIC now [ns].
[[nodiscard]] std::int64_t MonotonicNowNs() noexcept;
/// Returns at `due_ns` without giving the processor away, unless it is the only one.
void SpinUntil(std::int64_t due_ns) noexcept;
/// `spin_ns`, or 0 on a machine with one processor.
[[nodiscard]] std::int64_t AllowedSpinNs(std::int64_t spin_ns) noexcept;

}  // namespace levitas::rt
