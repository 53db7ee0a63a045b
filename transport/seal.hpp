#pragma once
// Who sent a datagram, and that it was not sent before: the trailer of a network with a key.
//
//   datagram | "LKY2" | sender, 64 bit | number, 64 bit | freshness, 64 bit | seal, 128 bit
//                                                                             all big-endian
//
// Sender   drawn at random at each start of a program, for each direction.
// Number   counts the datagrams of a sender, whatever any clock says.
// Fresh    what shows that a datagram was not recorded before. With a command: the challenge that
//          its receiver issued. Else: nanoseconds since 1970 (UTC) when it was sent.
// Seal     over everything before it, under the key of this group and port (network_key.hpp).
// Rules    kClock: of a sender already known, a larger number than its last one is enough. Of a new
//          one the time must be within kClockNs of this machine's clock, and later than the start
//          of this receiver. kChallenge: besides a larger number, one of the challenges issued
//          within kValidNs of this receiver's monotonic clock; no clock of the day is looked at.
//          What `seal_alone` names is taken with a good seal whatever else it says.
// Thread   one; the counters may be read from any. No allocation, no exception.

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <span>

#include "transport/network_key.hpp"

namespace levitas::transport {

inline constexpr std::size_t kTrailerBytes = 4 + 8 + 8 + 8 + SealingKey::kSealBytes;

class Sealer {
 public:
  explicit Sealer(const SealingKey& key);
  /// Appends the trailer: `buffer` holds the datagram in its first `size` bytes and has room for
  /// kTrailerBytes more. Returns the whole.
  [[nodiscard]] std::span<const std::uint8_t> Append(std::span<std::uint8_t> buffer,
                                                     std::size_t size,
                                                     std::uint64_t freshness) noexcept;
  [[nodiscard]] std::uint64_t sender() const noexcept { return sender_; }

 private:
  SealingKey key_;
  std::uint64_t sender_;
  std::uint64_t number_{0};
};

enum class SealWord : std::uint8_t {
  kGood,
  kNone,       ///< no trailer
  kVersion,    ///< the trailer of an older version
  kWrongKey,   ///< the seal is not of this key, or what it covers was changed
  kOld,        ///< repeated, or recorded before
  kClock,      ///< of a new sender, too far from this machine's clock
  kChallenge,  ///< with no challenge of this receiver, or one that is no longer valid
};
inline constexpr std::size_t kSealWords = 7;

/// What to say of a refused datagram; empty for kGood.
[[nodiscard]] const char* Text(SealWord word) noexcept;

enum class SealRule : std::uint8_t { kClock, kChallenge };

/// Both clocks of this machine at one instant.
struct SealNow {
  std::int64_t utc_ns{};
  std::int64_t monotonic_ns{};
};

class SealCheck {
 public:
  static constexpr std::int64_t kClockNs = 2'000'000'000;
  static constexpr std::int64_t kValidNs = 2'500'000'000;  ///< of a challenge, from its first issue
  static constexpr std::int64_t kRenewNs = 500'000'000;    ///< then another one is issued
  static constexpr std::size_t kSenders = 64;
  /// True for a datagram (without its trailer) that a good seal is enough for.
  using SealAlone = bool (*)(std::span<const std::uint8_t> datagram) noexcept;

  SealCheck(const SealingKey& key, SealRule rule, std::int64_t start_monotonic_ns,
            SealAlone seal_alone = nullptr) noexcept;

  /// Takes the trailer off `datagram` when it is good, and when it is of kClock.
  [[nodiscard]] SealWord Open(std::span<const std::uint8_t>& datagram, const SealNow& now) noexcept;
  /// Of the last datagram whose seal was good: who sent it.
  [[nodiscard]] std::uint64_t sender() const noexcept { return sender_; }
  /// The sender of the last datagram, of kClock, has proven otherwise that it speaks now.
  void Trust(std::int64_t monotonic_ns) noexcept;
  /// The challenge for whoever asks for one now; never 0.
  [[nodiscard]] std::uint64_t Challenge(std::int64_t monotonic_ns) noexcept;

  [[nodiscard]] std::uint64_t count(SealWord word) const noexcept {
    return counts_[static_cast<std::size_t>(word)].load(std::memory_order_relaxed);
  }
  /// How far the time of the last datagram of kClock was from our clock.
  [[nodiscard]] std::int64_t clock_off_ns() const noexcept {
    return clock_off_ns_.load(std::memory_order_relaxed);
  }

 private:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();
  static constexpr std::size_t kChallenges = kValidNs / kRenewNs + 1;  // valid at one time
  struct Known {
    std::uint64_t sender{0};
    std::uint64_t number{0};  ///< 0: an empty place
    std::int64_t heard_ns{kNever};
  };
  struct Issued {
    std::uint64_t challenge{0};
    std::int64_t at_ns{kNever};
  };
  [[nodiscard]] SealWord Judge(std::span<const std::uint8_t>& datagram,
                               const SealNow& now) noexcept;
  [[nodiscard]] SealWord Fresh(std::uint64_t number, std::uint64_t freshness,
                               const SealNow& now) noexcept;
  /// Of a new sender, by the time that it says.
  [[nodiscard]] SealWord Timely(std::int64_t sent_utc_ns, const SealNow& now) noexcept;
  [[nodiscard]] bool Valid(std::uint64_t challenge, std::int64_t monotonic_ns) const noexcept;
  [[nodiscard]] Known* Find(std::uint64_t sender) noexcept;
  void Note(std::uint64_t sender, std::uint64_t number, std::int64_t monotonic_ns) noexcept;

  SealingKey key_;
  SealRule rule_;
  SealAlone seal_alone_;
  std::int64_t floor_ns_;  ///< what was sent, or issued, until then proves nothing
  std::uint64_t sender_{0};
  std::uint64_t number_{0};  ///< of the last datagram of kClock
  std::array<Known, kSenders> known_{};
  std::array<Issued, kChallenges> issued_{};
  std::size_t newest_{0};
  std::array<std::atomic<std::uint64_t>, kSealWords> counts_{};
  std::atomic<std::int64_t> clock_off_ns_{0};
};

}  // namespace levitas::transport
