#pragma once
// The sampling grid: when the next period starts, and how many were skipped.
//
// Grid     due + k period, for ever: an overrun skips whole periods and never moves the phase, so
//          the sampling instants of the record stay equidistant.
// Units    nanoseconds of CLOCK_MONOTONIC.
// Policy   skip, not catch up: late cycles run back to back would answer samples that are old.

#include <cstdint>

namespace levitas::rt {

struct Wake {
  std::int64_t due_ns{};   ///< next instant of the grid that is still ahead
  std::int64_t skipped{};  ///< instants that had passed before the caller was ready
};

/// The instant after `due_ns`; `period_ns` must be positive.
[[nodiscard]] constexpr Wake NextWake(std::int64_t due_ns, std::int64_t period_ns,
                                      std::int64_t now_ns) noexcept {
  const std::int64_t next_ns = due_ns + period_ns;
  if (now_ns < next_ns) return {next_ns, 0};
  const std::int64_t skipped = (now_ns - next_ns) / period_ns + 1;
  return {next_ns + skipped * period_ns, skipped};
}

/// First instant of the grid `phase_ns + k period_ns` that is later than `now_ns`.
[[nodiscard]] constexpr std::int64_t FirstWake(std::int64_t phase_ns, std::int64_t period_ns,
                                               std::int64_t now_ns) noexcept {
  const std::int64_t past_ns = (now_ns - phase_ns) % period_ns;
  return now_ns + period_ns - (past_ns < 0 ? past_ns + period_ns : past_ns);
}

}  // namespace levitas::rt
