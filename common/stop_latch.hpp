#pragma once
// The emergency stop on its way from the thread that receives it to the loop: no queue that could
// be full, nothing that could be waited for.
//
// Counted  every stop that is asked for has a number; the loop takes all that are there at once.
//          A command belongs behind the stops that were counted before it (command_arbiter.hpp).
// Origins  who asked, for the answers. Best effort: the stop itself needs no room.
// Thread   Ask: one thread, the receiver's. Take and TakeOrigin: the loop's. asked: any. No
//          allocation, no lock, after construction.
// Failure  none: a stop that was asked for is taken in the loop's next cycle.

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "common/spsc_ring.hpp"

namespace levitas {

/// Which message a command came with.
struct CommandOrigin {
  std::uint64_t sender{0};   ///< address and port as one number; 0: not from the network
  std::int64_t sequence{0};  ///< the sender's own number of it
};

class StopLatch {
 public:
  static constexpr std::size_t kOrigins = 64;

  /// `received_ns`: CLOCK_MONOTONIC when the request was there, not 0.
  void Ask(std::int64_t received_ns, const CommandOrigin& origin) noexcept {
    origins_.Post(origin);
    std::int64_t none = 0;
    oldest_ns_.compare_exchange_strong(none, received_ns, std::memory_order_relaxed);
    asked_.fetch_add(1, std::memory_order_release);
  }

  /// True when a stop was asked for since the last call.
  [[nodiscard]] bool Take() noexcept {
    const std::uint64_t asked = asked_.load(std::memory_order_acquire);
    if (asked == taken_) return false;
    taken_ = asked;
    received_ns_ = oldest_ns_.exchange(0, std::memory_order_relaxed);
    return true;
  }
  /// The next of those who asked.
  [[nodiscard]] bool TakeOrigin(CommandOrigin& origin) noexcept { return origins_.Take(origin); }
  /// When the oldest of the stops that the last successful Take took was received; 0: not known.
  [[nodiscard]] std::int64_t received_ns() const noexcept { return received_ns_; }
  /// How many Take has taken.
  [[nodiscard]] std::uint64_t taken() const noexcept { return taken_; }

  [[nodiscard]] std::uint64_t asked() const noexcept {
    return asked_.load(std::memory_order_acquire);
  }

 private:
  SpscRing<CommandOrigin> origins_{kOrigins};
  alignas(64) std::atomic<std::uint64_t> asked_{0};
  std::atomic<std::int64_t> oldest_ns_{0};
  alignas(64) std::uint64_t taken_{0};  ///< the loop's own
  std::int64_t received_ns_{0};
};

}  // namespace levitas
