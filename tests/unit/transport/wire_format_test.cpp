// The bytes on the bus against LCM's documented formats, written out by hand: any other LCM program
// must be able to read them (UDP multicast protocol, version 1; type specification: big-endian,
// fields in order, IEEE 754 doubles, an array as its elements).

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "common/random.hpp"
#include "transport/frame_codec.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::transport {
namespace {

// Appends numbers as the specification says.
class Bytes {
 public:
  template <class Integer>
  Bytes& Big(Integer value) {
    for (int shift = 8 * static_cast<int>(sizeof(value)) - 8; shift >= 0; shift -= 8) {
      bytes_.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> shift));
    }
    return *this;
  }
  Bytes& Real(double value) { return Big(std::bit_cast<std::uint64_t>(value)); }
  Bytes& Text(const std::string& text) {
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(0);
    return *this;
  }
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

// LCM's hash of a type (lcm-gen: each name's length and letters, then each member's), so that the
// fingerprint is checked against the .lcm file and not against the program generated from it.
class TypeHash {
 public:
  TypeHash& Member(const std::string& name, const std::string& primitive) {
    Text(name);
    Text(primitive);
    Letter(0);  // no dimensions
    return *this;
  }
  TypeHash& Array(const std::string& name, const std::string& primitive, const std::string& size) {
    Text(name);
    Text(primitive);
    Letter(1);  // one dimension,
    Letter(1);  // whose size is a member
    Text(size);
    return *this;
  }
  // The finished fingerprint of a type without members that are types themselves.
  [[nodiscard]] std::uint64_t Fingerprint() const {
    return std::rotl(static_cast<std::uint64_t>(hash_), 1);
  }

 private:
  void Letter(char c) {
    const auto old = static_cast<std::uint64_t>(hash_);
    const auto shifted = static_cast<std::uint64_t>(hash_ >> 55);  // arithmetic, as in lcm-gen
    hash_ = static_cast<std::int64_t>(((old << 8) ^ shifted) +
                                      static_cast<std::uint64_t>(static_cast<std::int64_t>(c)));
  }
  void Text(const std::string& text) {
    Letter(static_cast<char>(text.size()));
    for (const char c : text) Letter(c);
  }
  std::int64_t hash_{0x12345678};
};

std::uint64_t SensorFingerprint() {
  return TypeHash()
      .Member("cycle", "int64_t")
      .Member("sample_time_ns", "int64_t")
      .Member("rig_session", "int32_t")
      .Member("rig_status", "int32_t")
      .Member("held_currents", "int32_t")
      .Member("axes", "int32_t")
      .Array("position_m", "double", "axes")
      .Member("speed_rad_per_s", "double")
      .Member("angle_rad", "double")
      .Fingerprint();
}

std::uint64_t CurrentFingerprint() {
  return TypeHash()
      .Member("cycle", "int64_t")
      .Member("axes", "int32_t")
      .Array("control_current_a", "double", "axes")
      .Member("bias_current_a", "double")
      .Member("speed_set_point_rad_per_s", "double")
      .Member("acceleration_limit_rad_per_s2", "double")
      .Member("amplifiers_enabled", "boolean")
      .Member("drive_enabled", "boolean")
      .Fingerprint();
}

SensorFrame RandomSensor(Random& random, std::size_t axes) {
  SensorFrame frame;
  frame.cycle = random.Bits() >> 1;  // a signed number on the bus
  frame.sample_time_ns = static_cast<std::int64_t>(random.Bits());
  frame.rig_session = static_cast<std::uint32_t>(random.Bits());
  frame.rig_status = static_cast<std::uint32_t>(random.Bits());
  frame.held_currents = static_cast<std::uint32_t>(random.Bits());
  frame.axes = static_cast<std::uint32_t>(axes);
  for (std::size_t i = 0; i < axes; ++i) frame.position_m[i] = 1e-4 * random.Normal();
  frame.speed_rad_per_s = 1e3 * random.Normal();
  frame.angle_rad = 6.28 * random.Uniform();
  return frame;
}

CurrentFrame RandomCurrent(Random& random, std::size_t axes) {
  CurrentFrame frame;
  frame.cycle = random.Bits() >> 1;
  frame.axes = static_cast<std::uint32_t>(axes);
  for (std::size_t i = 0; i < axes; ++i) frame.control_current_a[i] = random.Normal();
  frame.bias_current_a = random.Uniform();
  frame.speed_set_point_rad_per_s = 1e3 * random.Normal();
  frame.acceleration_limit_rad_per_s2 = 1e2 * random.Uniform();
  frame.amplifiers_enabled = random.Uniform() < 0.5;
  frame.drive_enabled = random.Uniform() < 0.5;
  return frame;
}

std::vector<std::uint8_t> SensorBytes(const SensorFrame& f, std::uint32_t sequence) {
  Bytes bytes;
  bytes.Big(std::uint32_t{0x4c433032}).Big(sequence).Text("LEVITAS_SENSOR");
  bytes.Big(SensorFingerprint()).Big(f.cycle).Big(f.sample_time_ns).Big(f.rig_session);
  bytes.Big(f.rig_status).Big(f.held_currents).Big(f.axes);
  for (std::size_t i = 0; i < f.axes; ++i) bytes.Real(f.position_m[i]);
  return bytes.Real(f.speed_rad_per_s).Real(f.angle_rad).bytes();
}

std::vector<std::uint8_t> CurrentBytes(const CurrentFrame& f, std::uint32_t sequence) {
  Bytes bytes;
  bytes.Big(std::uint32_t{0x4c433032}).Big(sequence).Text("LEVITAS_CURRENT");
  bytes.Big(CurrentFingerprint()).Big(f.cycle).Big(f.axes);
  for (std::size_t i = 0; i < f.axes; ++i) bytes.Real(f.control_current_a[i]);
  bytes.Real(f.bias_current_a).Real(f.speed_set_point_rad_per_s);
  bytes.Real(f.acceleration_limit_rad_per_s2);
  bytes.Big(std::uint8_t{f.amplifiers_enabled}).Big(std::uint8_t{f.drive_enabled});
  return bytes.bytes();
}

std::vector<std::uint8_t> Copy(std::span<const std::uint8_t> bytes) {
  return {bytes.begin(), bytes.end()};
}

class Wire : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Axes, Wire, testing::Range<std::size_t>(1, kMaxAxes + 1));

TEST_P(Wire, CarriesSensorFramesAsTheSpecificationSpellsThem) {
  Random random(40 + GetParam());
  SensorFrameCodec codec(GetParam());
  for (std::uint32_t sequence = 0; sequence < 200; ++sequence) {
    const SensorFrame frame = RandomSensor(random, GetParam());
    ASSERT_EQ(Copy(codec.Encode(frame)), SensorBytes(frame, sequence)) << sequence;
  }
}

TEST_P(Wire, CarriesCurrentFramesAsTheSpecificationSpellsThem) {
  Random random(50 + GetParam());
  CurrentFrameCodec codec(GetParam());
  for (std::uint32_t sequence = 0; sequence < 200; ++sequence) {
    const CurrentFrame frame = RandomCurrent(random, GetParam());
    ASSERT_EQ(Copy(codec.Encode(frame)), CurrentBytes(frame, sequence)) << sequence;
  }
}

TEST_P(Wire, ReadsSensorFramesThatSomebodyElseWrote) {
  Random random(60 + GetParam());
  SensorFrameCodec codec(GetParam());
  for (int i = 0; i < 200; ++i) {
    const SensorFrame frame = RandomSensor(random, GetParam());
    SensorFrame read;
    read.position_m.fill(7.0);  // what an earlier frame left must not stay
    ASSERT_TRUE(codec.Decode(ParsePacket(SensorBytes(frame, 3)).payload, read));
    EXPECT_EQ(read.cycle, frame.cycle);
    EXPECT_EQ(read.sample_time_ns, frame.sample_time_ns);
    EXPECT_EQ(read.rig_session, frame.rig_session);
    EXPECT_EQ(read.rig_status, frame.rig_status);
    EXPECT_EQ(read.held_currents, frame.held_currents);
    EXPECT_EQ(read.axes, frame.axes);
    EXPECT_EQ(read.position_m, frame.position_m);
    EXPECT_EQ(read.speed_rad_per_s, frame.speed_rad_per_s);
    EXPECT_EQ(read.angle_rad, frame.angle_rad);
  }
}

TEST_P(Wire, ReadsCurrentFramesThatSomebodyElseWrote) {
  Random random(70 + GetParam());
  CurrentFrameCodec codec(GetParam());
  for (int i = 0; i < 200; ++i) {
    const CurrentFrame frame = RandomCurrent(random, GetParam());
    CurrentFrame read;
    read.control_current_a.fill(7.0);
    ASSERT_TRUE(codec.Decode(ParsePacket(CurrentBytes(frame, 3)).payload, read));
    EXPECT_EQ(read.cycle, frame.cycle);
    EXPECT_EQ(read.control_current_a, frame.control_current_a);
    EXPECT_EQ(read.bias_current_a, frame.bias_current_a);
    EXPECT_EQ(read.speed_set_point_rad_per_s, frame.speed_set_point_rad_per_s);
    EXPECT_EQ(read.acceleration_limit_rad_per_s2, frame.acceleration_limit_rad_per_s2);
    EXPECT_EQ(read.amplifiers_enabled, frame.amplifiers_enabled);
    EXPECT_EQ(read.drive_enabled, frame.drive_enabled);
  }
}

TEST_P(Wire, RefusesAFrameCutAtAnyByteAndLeavesTheArgumentAlone) {
  Random random(80 + GetParam());
  SensorFrameCodec codec(GetParam());
  const auto whole = SensorBytes(RandomSensor(random, GetParam()), 9);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    // A block of its own size: reading past it is an error that the sanitizer sees.
    const std::vector<std::uint8_t> cut(whole.begin(),
                                        whole.begin() + static_cast<std::ptrdiff_t>(length));
    const Packet packet = ParsePacket(cut);
    SensorFrame read;
    read.cycle = 5;
    EXPECT_FALSE(packet.kind == PacketKind::kShort && codec.Decode(packet.payload, read)) << length;
    EXPECT_EQ(read.cycle, 5U);
  }
}

TEST_P(Wire, RefusesAFrameWithAnyBitOfItsTypeChanged) {
  Random random(90 + GetParam());
  SensorFrameCodec codec(GetParam());
  const auto whole = SensorBytes(RandomSensor(random, GetParam()), 9);
  const std::size_t type_at = HeaderSize("LEVITAS_SENSOR");
  for (std::size_t bit = 0; bit < 64; ++bit) {
    auto changed = whole;
    changed[type_at + bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    SensorFrame read;
    EXPECT_FALSE(codec.Decode(ParsePacket(changed).payload, read)) << bit;
  }
}

TEST(WireNumbers, CarriesNumbersThatAreNoneUnchanged) {
  // The controller, not the bus, decides what a reading that is no number means.
  SensorFrameCodec codec(2);
  SensorFrame frame;
  frame.position_m = {std::nan(""), -INFINITY};
  SensorFrame read;
  ASSERT_TRUE(codec.Decode(ParsePacket(codec.Encode(frame)).payload, read));
  EXPECT_TRUE(std::isnan(read.position_m[0]));
  EXPECT_EQ(read.position_m[1], -INFINITY);
}

TEST(LcmPacket, RoundTripsEveryChannelLength) {
  Random random(41);
  for (std::size_t length = 1; length <= kMaxChannel; ++length) {
    std::string channel;
    for (std::size_t i = 0; i < length; ++i) {
      channel += static_cast<char>('!' + random.Bits() % 94);
    }
    const auto sequence = static_cast<std::uint32_t>(random.Bits());
    std::vector<std::uint8_t> datagram(HeaderSize(channel) + length);
    WriteHeader(datagram, sequence, channel);
    const Packet packet = ParsePacket(datagram);
    ASSERT_EQ(packet.kind, PacketKind::kShort) << length;
    EXPECT_EQ(packet.channel, channel);
    EXPECT_EQ(packet.sequence, sequence);
    EXPECT_EQ(packet.payload.size(), length);
  }
}

}  // namespace
}  // namespace levitas::transport
