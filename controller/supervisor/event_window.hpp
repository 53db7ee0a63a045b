#pragma once
// Whether so many events fell into a window of cycles: keeps the cycles of the latest ones, as many
// as are the limit.
//
// Thread   one; allocates in the constructor only.
// Failure  none; a limit above the window is never reached by one event per cycle.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace levitas::supervisor {

class EventWindow {
 public:
  /// Full once `limit` events lie within `window_cycles`; `limit` at least 1.
  EventWindow(std::size_t limit, std::uint64_t window_cycles)
      : cycles_(limit), window_cycles_(window_cycles) {}

  void Add(std::uint64_t cycle, std::uint64_t events) noexcept {
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(events, cycles_.size()); ++i) {
      cycles_[next_] = cycle;
      next_ = next_ + 1 == cycles_.size() ? 0 : next_ + 1;
      count_ = std::min(count_ + 1, cycles_.size());
    }
  }
  [[nodiscard]] bool Full(std::uint64_t cycle) const noexcept {
    return count_ == cycles_.size() && cycle - cycles_[next_] < window_cycles_;
  }
  [[nodiscard]] std::size_t limit() const noexcept { return cycles_.size(); }

 private:
  std::vector<std::uint64_t> cycles_;  // oldest at next_ once all are used
  std::uint64_t window_cycles_;
  std::size_t next_{0};
  std::size_t count_{0};
};

}  // namespace levitas::supervisor
