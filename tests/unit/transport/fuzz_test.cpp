// Whatever the bus carries must be refused or understood, never more (run under the sanitizers).

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "common/random.hpp"
#include "transport/frame_codec.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::transport {
namespace {

constexpr std::uint64_t kSeed = 20261121;
constexpr int kPackets = 100'000;

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  // One to four changes of a byte, then possibly a shorter or longer packet.
  std::vector<std::uint8_t> operator()(std::span<const std::uint8_t> original) {
    std::vector<std::uint8_t> packet(original.begin(), original.end());
    for (std::size_t change = 0; change <= random_.Bits() % 4; ++change) {
      packet[random_.Bits() % packet.size()] = static_cast<std::uint8_t>(random_.Bits());
    }
    const auto shape = random_.Bits() % 4;
    if (shape == 0) packet.resize(random_.Bits() % packet.size());
    if (shape == 1) packet.resize(packet.size() + random_.Bits() % 64, 0xA5);
    return packet;
  }

 private:
  Random random_;
};

TEST(FrameCodecFuzz, SensorFramesAreRefusedUnlessLengthAndAxesFit) {
  SensorFrameCodec codec(4);
  const auto datagram = codec.Encode({});
  const std::vector<std::uint8_t> original(datagram.begin(), datagram.end());
  const std::size_t length = ParsePacket(original).payload.size();
  Mutator mutate(kSeed);
  int accepted = 0;
  for (int count = 0; count < kPackets; ++count) {
    const auto packet = mutate(original);
    const Packet parsed = ParsePacket(packet);
    SensorFrame frame;
    if (!codec.Decode(parsed.payload, frame)) continue;
    ++accepted;
    ASSERT_EQ(parsed.payload.size(), length);
    ASSERT_EQ(frame.axes, 4U);
  }
  // Changes of values alone stay readable: half of the packets keep their length.
  EXPECT_GT(accepted, kPackets / 100);
  EXPECT_LT(accepted, kPackets / 2);
}

TEST(FrameCodecFuzz, CurrentFramesAreRefusedUnlessLengthAndAxesFit) {
  CurrentFrameCodec codec(4);
  const auto datagram = codec.Encode({});
  const std::vector<std::uint8_t> original(datagram.begin(), datagram.end());
  Mutator mutate(kSeed + 1);
  int accepted = 0;
  for (int count = 0; count < kPackets; ++count) {
    const auto packet = mutate(original);
    CurrentFrame frame;
    if (!codec.Decode(ParsePacket(packet).payload, frame)) continue;
    ++accepted;
    ASSERT_EQ(frame.axes, 4U);
  }
  EXPECT_LT(accepted, kPackets / 2);
}

TEST(LcmPacketFuzz, ViewsNeverLeaveTheDatagram) {
  Random random(kSeed + 2);
  for (int count = 0; count < kPackets; ++count) {
    std::vector<std::uint8_t> packet(random.Bits() % 80);
    for (auto& byte : packet) byte = static_cast<std::uint8_t>(random.Bits() % 4);
    const std::array<std::uint8_t, 4> magic{'L', 'C', '0', '2'};
    if (packet.size() >= 4) std::copy(magic.begin(), magic.end(), packet.begin());
    const Packet parsed = ParsePacket(packet);
    if (parsed.kind != PacketKind::kShort) continue;
    ASSERT_EQ(HeaderSize(parsed.channel) + parsed.payload.size(), packet.size());
  }
}

}  // namespace
}  // namespace levitas::transport
