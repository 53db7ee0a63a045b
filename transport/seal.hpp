#pragma once
// Who sent a datagram, and that it was not sent before: the trailer of a network with a key.
//
//   datagram | "LKY1" | sender, 64 bit | number, 64 bit | seal, 128 bit        all big-endian
//
// Sender   drawn at random at each start of a program, for each direction.
// Number   grows with every datagram of a sender: the time in nanoseconds since 1970 (UTC), or one
//          more than the last where the clock stands or steps back.
// Seal     over everything before it, under the key of this group and port (network_key.hpp).
// Fresh    from a sender already known, a larger number than its last one. From a new one, a number
//          later than the start of this receiver and within kClockNs of its clock: what was
//          recorded of an earlier run is worth nothing. Commands also later on: one that was held
//          back is not executed afterwards.
// Thread   one; the counters may be read from any. No allocation, no exception.

#include <array>
#include <atomic>
#include <cstdint>
#include <span>

#include "transport/network_key.hpp"

namespace levitas::transport {

inline constexpr std::size_t kTrailerBytes = 4 + 8 + 8 + SealingKey::kSealBytes;

class Sealer {
 public:
  explicit Sealer(const SealingKey& key);
  /// Appends the trailer: `buffer` holds the datagram in its first `size` bytes and has room for
  /// kTrailerBytes more. Returns the whole.
  [[nodiscard]] std::span<const std::uint8_t> Append(std::span<std::uint8_t> buffer,
                                                     std::size_t size,
                                                     std::int64_t now_utc_ns) noexcept;

 private:
  SealingKey key_;
  std::uint64_t sender_;
  std::uint64_t number_{0};
};

enum class SealWord : std::uint8_t {
  kGood,
  kNone,      ///< no trailer
  kWrongKey,  ///< the seal is not of this key, or what it covers was changed
  kOld,       ///< repeated, or recorded before
  kClock,     ///< too far from this machine's clock
};
inline constexpr std::size_t kSealWords = 5;

/// What to say of a refused datagram; empty for kGood.
[[nodiscard]] const char* Text(SealWord word) noexcept;

class SealCheck {
 public:
  static constexpr std::int64_t kClockNs = 2'000'000'000;
  static constexpr std::size_t kSenders = 64;

  /// `always_timely`: the clock counts for every datagram, not only for a sender's first.
  SealCheck(const SealingKey& key, std::int64_t start_utc_ns, bool always_timely) noexcept;

  /// Takes the trailer off `datagram` when it is good.
  [[nodiscard]] SealWord Open(std::span<const std::uint8_t>& datagram,
                              std::int64_t now_utc_ns) noexcept;
  [[nodiscard]] std::uint64_t count(SealWord word) const noexcept {
    return counts_[static_cast<std::size_t>(word)].load(std::memory_order_relaxed);
  }
  /// How far the number of the last datagram of kClock was from our clock.
  [[nodiscard]] std::int64_t clock_off_ns() const noexcept {
    return clock_off_ns_.load(std::memory_order_relaxed);
  }

 private:
  struct Known {
    std::uint64_t sender{0};
    std::uint64_t number{0};
  };
  [[nodiscard]] SealWord Judge(std::span<const std::uint8_t>& datagram,
                               std::int64_t now_utc_ns) noexcept;
  [[nodiscard]] SealWord Fresh(std::uint64_t sender, std::uint64_t number,
                               std::int64_t now_utc_ns) noexcept;

  SealingKey key_;
  std::uint64_t floor_;  ///< a new sender's number is later
  bool always_timely_;
  std::array<Known, kSenders> known_{};
  std::array<std::atomic<std::uint64_t>, kSealWords> counts_{};
  std::atomic<std::int64_t> clock_off_ns_{0};
};

}  // namespace levitas::transport
