#include "transport/seal.hpp"

#include <sodium.h>

#include <algorithm>
#include <utility>

namespace levitas::transport {

namespace {

constexpr std::array<std::uint8_t, 4> kMark{'L', 'K', 'Y', '1'};
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

std::uint64_t Drawn() noexcept {
  std::uint64_t value = 0;
  randombytes_buf(&value, sizeof value);
  return value;
}

}  // namespace

Sealer::Sealer(const SealingKey& key) : key_(key), sender_(Drawn()) {}

std::span<const std::uint8_t> Sealer::Append(std::span<std::uint8_t> buffer, std::size_t size,
                                             std::int64_t now_utc_ns) noexcept {
  number_ =
      std::max(number_ + 1, static_cast<std::uint64_t>(std::max<std::int64_t>(now_utc_ns, 0)));
  const auto trailer = buffer.subspan(size, kTrailerBytes);
  std::copy(kMark.begin(), kMark.end(), trailer.begin());
  WriteBig(trailer.subspan(4, 8), sender_);
  WriteBig(trailer.subspan(12, 8), number_);
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
    case SealWord::kWrongKey:
      return "with another key, or changed on the way";
    case SealWord::kOld:
      return "repeated, or recorded before";
    case SealWord::kClock:
      return "too old, or of a machine whose clock differs";
  }
  return "";
}

SealCheck::SealCheck(const SealingKey& key, std::int64_t start_utc_ns, bool always_timely) noexcept
    : key_(key), floor_(static_cast<std::uint64_t>(start_utc_ns)), always_timely_(always_timely) {}

SealWord SealCheck::Open(std::span<const std::uint8_t>& datagram,
                         std::int64_t now_utc_ns) noexcept {
  const SealWord word = Judge(datagram, now_utc_ns);
  auto& count = counts_[static_cast<std::size_t>(word)];
  count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  return word;
}

SealWord SealCheck::Judge(std::span<const std::uint8_t>& datagram,
                          std::int64_t now_utc_ns) noexcept {
  if (datagram.size() < kTrailerBytes) return SealWord::kNone;
  const auto trailer = datagram.last(kTrailerBytes);
  if (!std::equal(kMark.begin(), kMark.end(), trailer.begin())) return SealWord::kNone;
  const auto seal = trailer.last(SealingKey::kSealBytes);
  if (!key_.Made(seal, datagram.first(datagram.size() - SealingKey::kSealBytes))) {
    return SealWord::kWrongKey;
  }
  const SealWord word =
      Fresh(ReadBig(trailer.subspan(4, 8)), ReadBig(trailer.subspan(12, 8)), now_utc_ns);
  if (word == SealWord::kGood) datagram = datagram.first(datagram.size() - kTrailerBytes);
  return word;
}

SealWord SealCheck::Fresh(std::uint64_t sender, std::uint64_t number,
                          std::int64_t now_utc_ns) noexcept {
  const auto off_ns = static_cast<std::int64_t>(number) - now_utc_ns;
  const bool timely = off_ns <= kClockNs && off_ns >= -kClockNs;
  auto place = std::find_if(known_.begin(), known_.end(),
                            [&](const Known& one) { return one.sender == sender; });
  const bool is_new = place == known_.end() || place->number == 0;
  if (!is_new && number <= place->number) return SealWord::kOld;
  if ((is_new || always_timely_) && !timely) {
    clock_off_ns_.store(off_ns, std::memory_order_relaxed);
    return SealWord::kClock;
  }
  if (is_new && number <= floor_) return SealWord::kOld;
  if (is_new) {
    // The sender that has been silent longest makes room; it may come back as a new one.
    place = std::min_element(known_.begin(), known_.end(),
                             [](const Known& a, const Known& b) { return a.number < b.number; });
    floor_ = std::max(floor_, place->number);
    place->sender = sender;
  }
  place->number = number;
  return SealWord::kGood;
}

}  // namespace levitas::transport
