#pragma once
// How often a controller tells its state: a hundred times a second, whatever its rate. Who plays a
// session as its messages keeps to the same cycles.
//
// Thread   any; pure. Failure: none.

#include <algorithm>
#include <cstdint>

namespace levitas::transport {

inline constexpr std::int64_t kStateEveryNs = 10'000'000;

/// Cycles from one state to the next; the numbers of the cycles that send one are its multiples.
[[nodiscard]] constexpr std::uint64_t CyclesPerState(std::int64_t period_ns) noexcept {
  return static_cast<std::uint64_t>(
      std::max<std::int64_t>(1, kStateEveryNs / std::max<std::int64_t>(1, period_ns)));
}

}  // namespace levitas::transport
