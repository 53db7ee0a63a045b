// Golden bytes are the published check values of the AUTOSAR E2E and CRC specifications.

#include "hil/can/protection.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "common/random.hpp"

namespace levitas::can {
namespace {

constexpr std::array<std::uint8_t, 9> kCheck{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
constexpr std::uint64_t kSeed = 20261121;

TEST(Checksums, GiveThePublishedCheckValues) {
  EXPECT_EQ(Crc8J1850(kCheck), 0x4B);
  EXPECT_EQ(Crc16Ccitt(kCheck), 0x29B1);
}

TEST(Profile11, GivesThePublishedBytesOfZerosUnderDataId0x123) {
  constexpr std::array<std::uint8_t, 3> kPublished{0xCC, 0x91, 0x76};
  for (std::uint8_t counter = 0; counter < kPublished.size(); ++counter) {
    std::array<std::uint8_t, 8> payload{};
    Protect(Profile::k11, 0x123, counter, payload);
    EXPECT_EQ(payload, (std::array<std::uint8_t, 8>{kPublished[counter], counter}));
    EXPECT_TRUE(Intact(Profile::k11, 0x123, payload));
  }
}

TEST(Profile5, GivesThePublishedBytesOfZerosUnderDataId0x1234) {
  std::array<std::uint8_t, 8> payload{};
  Protect(Profile::k5, 0x1234, 0, payload);
  EXPECT_EQ(payload, (std::array<std::uint8_t, 8>{0x1C, 0xCA}));
  EXPECT_TRUE(Intact(Profile::k5, 0x1234, payload));
}

TEST(Profile11, LeavesTheHighNibbleOfTheCounterToData) {
  std::array<std::uint8_t, 8> payload{0, 0xA0};
  Protect(Profile::k11, 7, 14, payload);
  EXPECT_EQ(payload[1], 0xAE);
  EXPECT_EQ(CounterOf(Profile::k11, payload), 14);
}

TEST(Profile11, RefusesTheReservedCounter15ThoughTheChecksumFits) {
  std::array<std::uint8_t, 8> payload{};
  Protect(Profile::k11, 7, 15, payload);
  EXPECT_FALSE(Intact(Profile::k11, 7, payload));
}

TEST(Protection, RefusesAPayloadUnderAnotherDataId) {
  std::array<std::uint8_t, 16> payload{};
  Protect(Profile::k11, 0x100, 3, payload);
  EXPECT_FALSE(Intact(Profile::k11, 0x110, payload));
  Protect(Profile::k5, 0x100, 3, payload);
  EXPECT_FALSE(Intact(Profile::k5, 0x110, payload));
}

TEST(Protection, RefusesWhatIsShorterThanItself) {
  const std::vector<std::uint8_t> none;
  EXPECT_FALSE(Intact(Profile::k11, 1, none));
  EXPECT_FALSE(Intact(Profile::k5, 1, std::array<std::uint8_t, 2>{}));
}

// A cyclic code finds every burst that is not longer than its checksum: how many it missed.
int MissedBursts(Profile profile, std::size_t bytes, unsigned width) {
  Random random(kSeed);
  std::vector<std::uint8_t> payload(bytes);
  for (auto& byte : payload) byte = static_cast<std::uint8_t>(random.Bits());
  Protect(profile, 0x110, 5, payload);
  // Bits of a payload in the order in which the checksum takes them: highest first.
  const auto flip = [](std::vector<std::uint8_t>& data, std::size_t bit) {
    data[bit / 8] = static_cast<std::uint8_t>(data[bit / 8] ^ (0x80U >> (bit % 8)));
  };
  const std::size_t first = profile == Profile::k11 ? 8 : 16;  // behind the checksum itself
  int missed = 0;
  for (std::size_t start = first; start + width <= 8 * bytes; ++start) {
    for (int pattern = 0; pattern < 64; ++pattern) {
      std::vector<std::uint8_t> damaged = payload;
      flip(damaged, start);  // a burst begins with a wrong bit
      const std::uint64_t others = random.Bits();
      for (unsigned at = 1; at < width; ++at) {
        if (((others >> at) & 1U) != 0) flip(damaged, start + at);
      }
      if (Intact(profile, 0x110, damaged)) ++missed;
    }
  }
  return missed;
}

TEST(Profile11, FindsEveryBurstOfEightBits) { EXPECT_EQ(MissedBursts(Profile::k11, 16, 8), 0); }
TEST(Profile5, FindsEveryBurstOfSixteenBits) { EXPECT_EQ(MissedBursts(Profile::k5, 24, 16), 0); }

TEST(Profile11, MissesRandomPayloadsAsRarelyAsEightBitsAllow) {
  Random random(kSeed + 1);
  constexpr int kPayloads = 200'000;
  int accepted = 0;
  for (int count = 0; count < kPayloads; ++count) {
    std::array<std::uint8_t, 16> payload{};
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random.Bits());
    if (Intact(Profile::k11, 0x110, payload)) ++accepted;
  }
  // 15 of 16 counters, 1 of 256 checksums: 732 expected, standard deviation 27; 5 of them.
  EXPECT_NEAR(accepted, kPayloads / 256.0 * 15.0 / 16.0, 136.0);
}

TEST(Profiles, ChangeFromElevenToFiveBehindSixteenBytes) {
  EXPECT_EQ(ProfileFor(16), Profile::k11);
  EXPECT_EQ(ProfileFor(20), Profile::k5);
}

}  // namespace
}  // namespace levitas::can
