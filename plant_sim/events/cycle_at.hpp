#pragma once
// The cycle in which what happens at a time is first seen.
//
// Thread   any. Failure: none; `period_s` must be positive.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace levitas::events {

/// The first sample at or after the time; the millionth forgives rounding of the quotient.
[[nodiscard]] inline std::uint64_t CycleAt(double time_s, double period_s) noexcept {
  return static_cast<std::uint64_t>(std::ceil(std::max(time_s, 0.0) / period_s - 1e-6));
}

}  // namespace levitas::events
