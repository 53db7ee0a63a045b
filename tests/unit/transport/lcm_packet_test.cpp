#include "transport/lcm_packet.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace levitas::transport {
namespace {

std::vector<std::uint8_t> BytesOf(const std::string& text) { return {text.begin(), text.end()}; }

TEST(LcmPacket, HeaderIsTheDocumentedByteSequence) {
  std::vector<std::uint8_t> into(HeaderSize("AB"));
  WriteHeader(into, 0x01020304, "AB");
  // LCM UDP multicast protocol: magic 0x4c433032, sequence, channel, zero; big-endian.
  const std::vector<std::uint8_t> documented{0x4c, 0x43, 0x30, 0x32, 1, 2, 3, 4, 'A', 'B', 0};
  EXPECT_EQ(into, documented);
}

TEST(LcmPacket, ParsesWhatItWrites) {
  std::vector<std::uint8_t> datagram(HeaderSize("LEVITAS_SENSOR"));
  WriteHeader(datagram, 4'000'000'000U, "LEVITAS_SENSOR");
  datagram.insert(datagram.end(), {7, 8, 9});
  const Packet packet = ParsePacket(datagram);
  EXPECT_EQ(packet.kind, PacketKind::kShort);
  EXPECT_EQ(packet.sequence, 4'000'000'000U);
  EXPECT_EQ(packet.channel, "LEVITAS_SENSOR");
  EXPECT_EQ(std::vector<std::uint8_t>(packet.payload.begin(), packet.payload.end()),
            (std::vector<std::uint8_t>{7, 8, 9}));
}

TEST(LcmPacket, KnowsAFragmentWithoutReadingIt) {
  EXPECT_EQ(ParsePacket(BytesOf("LC03....")).kind, PacketKind::kFragment);
}

TEST(LcmPacket, AnEmptyPayloadIsAMessage) {
  const auto datagram = BytesOf(std::string("LC02\0\0\0\1A\0", 10));
  const Packet packet = ParsePacket(datagram);
  EXPECT_EQ(packet.kind, PacketKind::kShort);
  EXPECT_TRUE(packet.payload.empty());
}

TEST(LcmPacket, CallsEverythingElseMalformed) {
  EXPECT_EQ(ParsePacket({}).kind, PacketKind::kMalformed);
  EXPECT_EQ(ParsePacket(BytesOf("LC02")).kind, PacketKind::kMalformed);
  EXPECT_EQ(ParsePacket(BytesOf("LC02....")).kind, PacketKind::kMalformed);     // no channel
  EXPECT_EQ(ParsePacket(BytesOf("LC02....ABC")).kind, PacketKind::kMalformed);  // unterminated
  EXPECT_EQ(ParsePacket(BytesOf("HTTP/1.1 200")).kind, PacketKind::kMalformed);
  EXPECT_EQ(ParsePacket(BytesOf(std::string("LC02....\0", 9))).kind, PacketKind::kMalformed);
}

TEST(LcmPacket, TakesAChannelOf63BytesAndRefusesOneOf64) {
  const auto with = [](std::size_t length) {
    return BytesOf("LC02...." + std::string(length, 'C') + std::string(1, '\0'));
  };
  EXPECT_EQ(ParsePacket(with(kMaxChannel)).kind, PacketKind::kShort);
  EXPECT_EQ(ParsePacket(with(kMaxChannel + 1)).kind, PacketKind::kMalformed);
}

}  // namespace
}  // namespace levitas::transport
