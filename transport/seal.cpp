#include "transport/seal.hpp"

#include <sodium.h>

#include <algorithm>
#include <utility>

namespace levitas::transport {

namespace {

constexpr std::array<std::uint8_t, 4> kMark{'L', 'K', 'Y', '2'};
// Of the first version: sender, time, seal.
constexpr std::array<std::uint8_t, 4> kFirstMark{'L', 'K', 'Y', '1'};
constexpr std::size_t kFirstBytes = 4 + 8 + 8 + SealingKey::kSealBytes;
constexpr std::size_t kSealedBytes = kTrailerBytes - SealingKey::kSealBytes;

void WriteBig(std::span<std::uint8_t> into, std::uint64_t value) noexcept {
  for (std::size_t byte = 0; byte < 8; ++byte) {
    into[byte] = static_cast<std::uint8_t>(value >> (56 - 8 * byte));
  }
}

std::uint64_t ReadBig(std::span<const std::uint8_t> from) noexcept {
  std::uint64_t value = 0;
  for (std::size_t byte = 0; byte < 8; ++byte) value = value << 8U | from[byte];
  return value;
}

/// Never 0.
std::uint64_t Drawn() noexcept {
  std::uint64_t value = 0;
  while (value == 0) randombytes_buf(&value, sizeof value);
  return value;
}

bool Ends(std::span<const std::uint8_t> datagram, std::size_t trailer_bytes,
          const std::array<std::uint8_t, 4>& mark) noexcept {
  return datagram.size() >= trailer_bytes &&
         std::equal(mark.begin(), mark.end(), datagram.last(trailer_bytes).begin());
}

}  // namespace

Sealer::Sealer(const SealingKey& key) : key_(key), sender_(Drawn()) {}

std::span<const std::uint8_t> Sealer::Append(std::span<std::uint8_t> buffer, std::size_t size,
                                             std::uint64_t freshness) noexcept {
  const auto trailer = buffer.subspan(size, kTrailerBytes);
  std::copy(kMark.begin(), kMark.end(), trailer.begin());
  WriteBig(trailer.subspan(4, 8), sender_);
  WriteBig(trailer.subspan(12, 8), ++number_);
  WriteBig(trailer.subspan(20, 8), freshness);
  const SealingKey::Seal seal = key_.SealOf(buffer.first(size + kSealedBytes));
  std::copy(seal.begin(), seal.end(), trailer.begin() + kSealedBytes);
  return buffer.first(size + kTrailerBytes);
}

const char* Text(SealWord word) noexcept {
  switch (word) {
    case SealWord::kGood:
      return "";
    case SealWord::kNone:
      return "without a key";
    case SealWord::kVersion:
      return "with the seal LKY1 of an older Levitas (here LKY2: install one version on all "
             "machines)";
    case SealWord::kWrongKey:
      return "with another key, or changed on the way";
    case SealWord::kOld:
      return "repeated, or recorded before";
    case SealWord::kClock:
      return "too old, or of a machine whose clock differs";
    case SealWord::kChallenge:
      return "recorded before, or given without a challenge";
  }
  return "";
}

SealCheck::SealCheck(const SealingKey& key, SealRule rule, std::int64_t start_monotonic_ns,
                     SealAlone seal_alone) noexcept
    : key_(key), rule_(rule), seal_alone_(seal_alone), floor_ns_(start_monotonic_ns) {}

SealWord SealCheck::Open(std::span<const std::uint8_t>& datagram, const SealNow& now) noexcept {
  const SealWord word = Judge(datagram, now);
  auto& count = counts_[static_cast<std::size_t>(word)];
  count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  return word;
}

SealWord SealCheck::Judge(std::span<const std::uint8_t>& datagram, const SealNow& now) noexcept {
  if (!Ends(datagram, kTrailerBytes, kMark)) {
    return Ends(datagram, kFirstBytes, kFirstMark) ? SealWord::kVersion : SealWord::kNone;
  }
  const auto trailer = datagram.last(kTrailerBytes);
  const auto seal = trailer.last(SealingKey::kSealBytes);
  if (!key_.Made(seal, datagram.first(datagram.size() - SealingKey::kSealBytes))) {
    return SealWord::kWrongKey;
  }
  sender_ = ReadBig(trailer.subspan(4, 8));
  const std::uint64_t number = ReadBig(trailer.subspan(12, 8));
  const auto inner = datagram.first(datagram.size() - kTrailerBytes);
  if (seal_alone_ != nullptr && seal_alone_(inner)) {
    // What its sender said before it is older. A sender that is not known proves nothing by it,
    // and takes nobody's place: it may be a record.
    if (const Known* known = Find(sender_); known != nullptr && number > known->number) {
      Note(sender_, number, now.monotonic_ns);
    }
    datagram = inner;
    return SealWord::kGood;
  }
  const SealWord word = Fresh(number, ReadBig(trailer.subspan(20, 8)), now);
  if (word == SealWord::kClock) number_ = number;
  if (word == SealWord::kGood || word == SealWord::kClock) datagram = inner;
  return word;
}

SealWord SealCheck::Fresh(std::uint64_t number, std::uint64_t freshness,
                          const SealNow& now) noexcept {
  const Known* known = Find(sender_);
  if (number == 0 || (known != nullptr && number <= known->number)) return SealWord::kOld;
  if (rule_ == SealRule::kChallenge) {
    if (!Valid(freshness, now.monotonic_ns)) return SealWord::kChallenge;
  } else if (known == nullptr) {
    const SealWord word = Timely(static_cast<std::int64_t>(freshness), now);
    if (word != SealWord::kGood) return word;
  }
  Note(sender_, number, now.monotonic_ns);
  return SealWord::kGood;
}

// The age of a datagram is counted on the clocks of the day, which may be set at any time; what it
// is compared with, how long this receiver lives, on the one that is never set.
SealWord SealCheck::Timely(std::int64_t sent_utc_ns, const SealNow& now) noexcept {
  std::int64_t off_ns = 0;
  const bool counted = !__builtin_sub_overflow(sent_utc_ns, now.utc_ns, &off_ns);
  if (!counted || off_ns > kClockNs || off_ns < -kClockNs) {
    clock_off_ns_.store(off_ns, std::memory_order_relaxed);
    return SealWord::kClock;
  }
  return now.monotonic_ns + off_ns > floor_ns_ ? SealWord::kGood : SealWord::kOld;
}

bool SealCheck::Valid(std::uint64_t challenge, std::int64_t monotonic_ns) const noexcept {
  return std::any_of(issued_.begin(), issued_.end(), [&](const Issued& one) {
    return one.challenge != 0 && one.challenge == challenge && one.at_ns > floor_ns_ &&
           monotonic_ns - one.at_ns <= kValidNs;
  });
}

std::uint64_t SealCheck::Challenge(std::int64_t monotonic_ns) noexcept {
  const Issued& newest = issued_[newest_];
  const bool serves =
      newest.challenge != 0 && newest.at_ns > floor_ns_ && monotonic_ns - newest.at_ns < kRenewNs;
  if (!serves) {
    newest_ = (newest_ + 1) % kChallenges;
    // In the same nanosecond as the floor it would not count.
    issued_[newest_] = {Drawn(), std::max(monotonic_ns, floor_ns_ + 1)};
  }
  return issued_[newest_].challenge;
}

void SealCheck::Trust(std::int64_t monotonic_ns) noexcept {
  if (number_ != 0) Note(sender_, number_, monotonic_ns);
  number_ = 0;
}

SealCheck::Known* SealCheck::Find(std::uint64_t sender) noexcept {
  const auto found = std::find_if(known_.begin(), known_.end(), [sender](const Known& one) {
    return one.number != 0 && one.sender == sender;
  });
  return found == known_.end() ? nullptr : &*found;
}

void SealCheck::Note(std::uint64_t sender, std::uint64_t number,
                     std::int64_t monotonic_ns) noexcept {
  Known* place = Find(sender);
  if (place == nullptr) {
    // The sender that has been silent longest makes room; it may come back as a new one, with what
    // is younger than all that was heard of it.
    place = &*std::min_element(known_.begin(), known_.end(), [](const Known& a, const Known& b) {
      return a.heard_ns < b.heard_ns;
    });
    floor_ns_ = std::max(floor_ns_, place->heard_ns);
  }
  *place = {sender, number, monotonic_ns};
}

}  // namespace levitas::transport
