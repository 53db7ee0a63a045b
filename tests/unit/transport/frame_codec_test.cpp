#include "transport/frame_codec.hpp"

#include <gtest/gtest.h>

#include "tests/support/allocation_guard.hpp"
#include "transport/lcm_network.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::transport {
namespace {

SensorFrame Sensor() {
  SensorFrame frame;
  frame.cycle = 0x1122334455;
  frame.sample_time_ns = -7;
  frame.rig_session = 0xFEDCBA98;
  frame.rig_status = kRigEmergencyStop | kRigAmplifiersOff;
  frame.held_currents = 3;
  frame.axes = 4;
  frame.position_m = {1e-6, -2e-6, 3.5e-6, 0.0};
  frame.speed_rad_per_s = 314.25;
  frame.angle_rad = 6.25;
  return frame;
}

CurrentFrame Current() {
  CurrentFrame frame;
  frame.cycle = 99;
  frame.axes = 4;
  frame.control_current_a = {0.5, -0.25, 0.125, -1.0};
  frame.bias_current_a = 1.0;
  frame.speed_set_point_rad_per_s = 10.0;
  frame.acceleration_limit_rad_per_s2 = 20.0;
  frame.amplifiers_enabled = true;
  return frame;
}

std::vector<std::uint8_t> Payload(std::span<const std::uint8_t> datagram) {
  const Packet packet = ParsePacket(datagram);
  return {packet.payload.begin(), packet.payload.end()};
}

TEST(SensorFrameCodec, WritesWhatTheGeneratedTypeReads) {
  SensorFrameCodec codec(4);
  const auto payload = Payload(codec.Encode(Sensor()));
  levitas_msg::sensor_frame_t message;
  ASSERT_EQ(message.decode(payload.data(), 0, static_cast<int>(payload.size())),
            static_cast<int>(payload.size()));
  EXPECT_EQ(message.cycle, 0x1122334455);
  EXPECT_EQ(message.sample_time_ns, -7);
  EXPECT_EQ(message.rig_status, 9);
  EXPECT_EQ(message.held_currents, 3);
  EXPECT_EQ(message.position_m, (std::vector<double>{1e-6, -2e-6, 3.5e-6, 0.0}));
  EXPECT_EQ(message.speed_rad_per_s, 314.25);
  EXPECT_EQ(message.angle_rad, 6.25);
}

TEST(SensorFrameCodec, GivesBackEveryField) {
  SensorFrameCodec codec(4);
  const auto payload = Payload(codec.Encode(Sensor()));
  SensorFrame read;
  ASSERT_TRUE(codec.Decode(payload, read));
  EXPECT_EQ(read.cycle, Sensor().cycle);
  EXPECT_EQ(read.sample_time_ns, Sensor().sample_time_ns);
  EXPECT_EQ(read.rig_session, Sensor().rig_session);
  EXPECT_EQ(read.rig_status, Sensor().rig_status);
  EXPECT_EQ(read.held_currents, Sensor().held_currents);
  EXPECT_EQ(read.axes, 4U);
  EXPECT_EQ(read.position_m, Sensor().position_m);
  EXPECT_EQ(read.speed_rad_per_s, Sensor().speed_rad_per_s);
  EXPECT_EQ(read.angle_rad, Sensor().angle_rad);
}

TEST(CurrentFrameCodec, GivesBackEveryField) {
  CurrentFrameCodec codec(4);
  const auto payload = Payload(codec.Encode(Current()));
  CurrentFrame read;
  ASSERT_TRUE(codec.Decode(payload, read));
  EXPECT_EQ(read.cycle, 99U);
  EXPECT_EQ(read.control_current_a, Current().control_current_a);
  EXPECT_EQ(read.bias_current_a, 1.0);
  EXPECT_EQ(read.speed_set_point_rad_per_s, 10.0);
  EXPECT_EQ(read.acceleration_limit_rad_per_s2, 20.0);
  EXPECT_TRUE(read.amplifiers_enabled);
  EXPECT_FALSE(read.drive_enabled);
}

TEST(CurrentFrameCodec, GoodbyeIsTheSameMessageOnItsOwnChannel) {
  CurrentFrameCodec codec(4);
  EXPECT_EQ(ParsePacket(codec.Encode(Current())).channel, channel::kCurrent);
  const auto datagram = codec.EncodeGoodbye(Current());
  EXPECT_EQ(ParsePacket(datagram).channel, channel::kGoodbye);
  CurrentFrame read;
  EXPECT_TRUE(codec.Decode(Payload(datagram), read));
}

TEST(FrameCodec, CountsItsMessages) {
  SensorFrameCodec codec(2);
  EXPECT_EQ(ParsePacket(codec.Encode({})).sequence, 0U);
  EXPECT_EQ(ParsePacket(codec.Encode({})).sequence, 1U);
}

TEST(FrameCodec, RefusesARigWithAnotherAxisCountAndLeavesTheFrameAlone) {
  SensorFrameCodec two(2);
  SensorFrameCodec four(4);
  SensorFrame read;
  read.cycle = 5;
  EXPECT_FALSE(four.Decode(Payload(two.Encode(Sensor())), read));
  EXPECT_FALSE(two.Decode(Payload(four.Encode(Sensor())), read));
  EXPECT_EQ(read.cycle, 5U);
}

TEST(FrameCodec, RefusesTheOtherMessageOfTheSameRig) {
  SensorFrameCodec sensor(4);
  CurrentFrameCodec current(4);
  SensorFrame frame;
  EXPECT_FALSE(sensor.Decode(Payload(current.Encode(Current())), frame));
}

TEST(FrameCodec, RefusesAnAxisCountThatNoFrameCarries) {
  EXPECT_THROW(SensorFrameCodec(0), std::invalid_argument);
  EXPECT_THROW(CurrentFrameCodec(kMaxAxes + 1), std::invalid_argument);
}

TEST(FrameCodec, AllocatesNothingIn10000Cycles) {
  SensorFrameCodec sensor(kMaxAxes);
  CurrentFrameCodec current(kMaxAxes);
  SensorFrame frame;
  CurrentFrame answer;
  std::uint64_t decoded = 0;
  const test::AllocationGuard guard;
  for (int cycle = 0; cycle < 10'000; ++cycle) {
    const Packet out = ParsePacket(sensor.Encode(frame));
    if (sensor.Decode(out.payload, frame)) ++decoded;
    const Packet back = ParsePacket(current.Encode(answer));
    if (current.Decode(back.payload, answer)) ++decoded;
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(decoded, 20'000U);
}

}  // namespace
}  // namespace levitas::transport
