#pragma once
// Sealed datagrams and the receiver's two clocks, written out.

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "transport/seal.hpp"

namespace levitas::transport::test {

inline constexpr std::int64_t kSecond = 1'000'000'000;
inline constexpr std::int64_t kNow = 1'800'000'000 * kSecond;  // some day in 2027
inline constexpr std::size_t kSize = 120;

inline NetworkKey Key(std::uint8_t first = 1) {
  SealingKey::Bytes secret{};
  secret[0] = first;
  return {secret, "test"};
}

inline constexpr std::int64_t kHour = 3600 * kSecond;
inline constexpr std::int64_t kDay = 24 * kHour;
inline constexpr std::int64_t kUp = 5000 * kSecond;  // since the receiver's machine was switched on

/// A datagram of `kSize` bytes, sealed.
inline std::vector<std::uint8_t> Sealed(Sealer& sealer, std::int64_t freshness,
                                        std::uint8_t fill = 7) {
  std::vector<std::uint8_t> buffer(kSize + kTrailerBytes, fill);
  const auto whole = sealer.Append(buffer, kSize, static_cast<std::uint64_t>(freshness));
  return {whole.begin(), whole.end()};
}

/// `now_ns` of the day, on a machine whose clock has never been set since the start.
inline SealNow At(std::int64_t now_ns) { return {now_ns, kUp + now_ns - kNow}; }

inline SealWord Open(SealCheck& check, const std::vector<std::uint8_t>& datagram,
                     const SealNow& now) {
  std::span<const std::uint8_t> view = datagram;
  const SealWord word = check.Open(view, now);
  const bool opened = word == SealWord::kGood || word == SealWord::kClock;
  EXPECT_EQ(view.size(), opened ? kSize : datagram.size());
  return word;
}

inline SealWord Open(SealCheck& check, const std::vector<std::uint8_t>& datagram,
                     std::int64_t now_ns) {
  return Open(check, datagram, At(now_ns));
}

}  // namespace levitas::transport::test
