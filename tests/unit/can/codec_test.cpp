#include "hil/can/codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/allocation_guard.hpp"
#include "tests/unit/can/rigs.hpp"

namespace levitas::can {
namespace {

constexpr std::uint64_t kCodecSeed = 20261121;
constexpr int kFrames = 20'000;

MessageCodec CodecOf(const Layout& layout, const std::string& name) {
  return {MessageNamed(layout, name), layout.format};
}

// Written by hand from the table of docs/real_rig.md: 2.5 um is 250 steps of 10 nm (0x00FA), -1 um
// is -100 (0xFF9C), cycle 0xABC, session 2, speed 100 rad/s is 1000 steps (0x003E8), angle pi is
// 0x8000.
TEST(Codec, PutsTheBytesOfAPositionFrameWhereTheTableSays) {
  const Layout layout = MakeLayout(TestRig(4), Format::kFd);
  MessageCodec codec = CodecOf(layout, "RigPositions");
  SensorFrame frame;
  frame.cycle = 0x5ABC;
  frame.rig_session = 2;
  frame.rig_status = kRigEmergencyStop | kRigAmplifiersOff;
  frame.position_m = {2.5e-6, -1e-6, 0.0, 327.67e-6};
  frame.speed_rad_per_s = 100.0;
  frame.angle_rad = 3.14159265358979;
  const WireFrame wire = codec.Encode(ValuesOf(frame));
  ASSERT_EQ(wire.length, 16);
  EXPECT_EQ(wire.id, 0x110U);
  EXPECT_EQ(wire.data[1], 0x90);  // counter 0; stop is bit 12, amplifiers off bit 15
  EXPECT_EQ(wire.data[2], 0xFA);
  EXPECT_EQ(wire.data[3], 0x00);
  EXPECT_EQ(wire.data[4], 0x9C);
  EXPECT_EQ(wire.data[5], 0xFF);
  EXPECT_EQ(wire.data[8], 0xFF);
  EXPECT_EQ(wire.data[9], 0x7F);
  EXPECT_EQ(wire.data[10], 0xBC);
  // 4 bits of the cycle (A), then session 2 (10), then the two lowest bits of the speed (00).
  EXPECT_EQ(wire.data[11], 0x2A);
  EXPECT_EQ(wire.data[12], 0xFA);  // 1000 >> 2
  EXPECT_EQ(wire.data[13], 0x00);
  EXPECT_EQ(wire.data[14], 0x00);
  EXPECT_EQ(wire.data[15], 0x80);
}

TEST(Codec, CountsTheAliveCounterFromZeroToFourteen) {
  const Layout layout = MakeLayout(TestRig(4), Format::kFd);
  MessageCodec codec = CodecOf(layout, "ControllerCurrents");
  for (int count = 0; count < 40; ++count) {
    EXPECT_EQ(codec.Counter(codec.Encode({})), count % 15);
  }
}

class EveryCodec : public testing::TestWithParam<std::tuple<std::size_t, Format>> {};

TEST_P(EveryCodec, ReturnsEachNumberWithinHalfAStep) {
  const auto [axes, format] = GetParam();
  Random random(kCodecSeed);
  for (const Message& message : MakeLayout(TestRig(axes), format).messages) {
    MessageCodec codec(message, format);
    for (int count = 0; count < kFrames / 10; ++count) {
      const Values rig = ValuesOf(RandomSensorFrame(random, axes));
      const Values currents = ValuesOf(RandomCurrentFrame(random, axes), random.Bits() % 2 == 0);
      const Values& sent = message.sender == Sender::kRig ? rig : currents;
      Values got;
      ASSERT_TRUE(codec.Decode(codec.Encode(sent), got));
      for (const Signal& signal : message.signals) {
        const double half = 0.5001 * signal.factor;  // rounding, and that of the comparison
        if (signal.field == Field::kPosition) {
          ASSERT_NEAR(got.position_m[signal.axis], sent.position_m[signal.axis], half);
        } else if (signal.field == Field::kCurrent) {
          ASSERT_NEAR(got.control_current_a[signal.axis], sent.control_current_a[signal.axis],
                      half);
        } else if (signal.field == Field::kSpeed) {
          ASSERT_NEAR(got.speed_rad_per_s, sent.speed_rad_per_s, half);
        } else if (signal.field == Field::kAngle) {
          ASSERT_NEAR(got.angle_rad, sent.angle_rad, half);
        } else if (signal.field == Field::kBias) {
          ASSERT_NEAR(got.bias_current_a, sent.bias_current_a, half);
        } else if (signal.field == Field::kSpeedSetPoint) {
          ASSERT_NEAR(got.speed_set_point_rad_per_s, sent.speed_set_point_rad_per_s, half);
        } else if (signal.field == Field::kCycle) {
          ASSERT_EQ(got.cycle_low, sent.cycle_low % 4096);
        } else if (signal.field == Field::kGoodbye) {
          ASSERT_EQ(got.goodbye, sent.goodbye);
        } else if (signal.field == Field::kAmplifiersEnabled) {
          ASSERT_EQ(got.amplifiers_enabled, sent.amplifiers_enabled);
        }
      }
      // Every positions message carries the whole status.
      if (message.sender == Sender::kRig && message.every == 1) {
        ASSERT_EQ(got.rig_status, sent.rig_status);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AxesAndFormats, EveryCodec,
                         testing::Combine(testing::Values(1, 2, 4, 5, 8),
                                          testing::Values(Format::kFd, Format::kClassical)));

TEST(Codec, CarriesWhatIsNotFiniteAsAbsent) {
  const Layout layout = MakeLayout(TestRig(4), Format::kFd);
  MessageCodec codec = CodecOf(layout, "RigPositions");
  for (const double absent :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    SensorFrame frame;
    frame.position_m[2] = absent;
    frame.speed_rad_per_s = absent;
    Values got;
    ASSERT_TRUE(codec.Decode(codec.Encode(ValuesOf(frame)), got));
    EXPECT_TRUE(std::isnan(got.position_m[2]));
    EXPECT_TRUE(std::isnan(got.speed_rad_per_s));
    EXPECT_EQ(got.position_m[1], 0.0);
  }
}

TEST(Codec, StopsAtTheLastStepAndNeverWrapsRound) {
  const Layout layout = MakeLayout(TestRig(4), Format::kFd);
  MessageCodec codec = CodecOf(layout, "RigPositions");
  for (const double sign : {1.0, -1.0}) {
    for (const double far_m : {327.68e-6, 1e-3, 1.0, 1e300}) {
      SensorFrame frame;
      frame.position_m[0] = sign * far_m;
      Values got;
      ASSERT_TRUE(codec.Decode(codec.Encode(ValuesOf(frame)), got));
      EXPECT_NEAR(got.position_m[0], sign * 327.67e-6, 1e-12);
    }
  }
}

TEST(Codec, TakesAnAngleThatRoundsToAWholeTurnForZero) {
  const Layout layout = MakeLayout(TestRig(4), Format::kFd);
  MessageCodec codec = CodecOf(layout, "RigPositions");
  SensorFrame frame;
  frame.angle_rad = 6.28318;
  Values got;
  ASSERT_TRUE(codec.Decode(codec.Encode(ValuesOf(frame)), got));
  EXPECT_EQ(got.angle_rad, 0.0);
}

TEST(Codec, RefusesAnyOtherLengthFormatOrIdentifier) {
  const Layout layout = MakeLayout(TestRig(4), Format::kFd);
  MessageCodec codec = CodecOf(layout, "RigPositions");
  const WireFrame good = codec.Encode({});
  Values got;
  ASSERT_TRUE(codec.Decode(good, got));
  for (int length = 0; length <= 64; ++length) {
    if (length == good.length) continue;
    WireFrame other = good;
    other.length = static_cast<std::uint8_t>(length);
    EXPECT_FALSE(codec.Decode(other, got)) << length;
  }
  WireFrame classical = good;
  classical.fd = false;
  EXPECT_FALSE(codec.Decode(classical, got));
  WireFrame other = good;
  other.id = kCurrentsId;
  EXPECT_FALSE(codec.Decode(other, got));
}

TEST(Codec, LeavesItsArgumentUntouchedWhenItRefuses) {
  const Layout layout = MakeLayout(TestRig(4), Format::kFd);
  MessageCodec codec = CodecOf(layout, "RigPositions");
  SensorFrame frame;
  frame.position_m[0] = 1e-4;
  WireFrame wire = codec.Encode(ValuesOf(frame));
  wire.data[5] ^= 1U;
  Values got;
  got.position_m[0] = 7.0;
  EXPECT_FALSE(codec.Decode(wire, got));
  EXPECT_EQ(got.position_m[0], 7.0);
}

TEST(Codec, AllocatesNothing) {
  const Layout layout = MakeLayout(TestRig(8), Format::kFd);
  MessageCodec codec = CodecOf(layout, "RigPositions");
  Values values;
  const test::AllocationGuard guard;
  for (int count = 0; count < 1000; ++count) {
    const WireFrame wire = codec.Encode(values);
    ASSERT_TRUE(codec.Decode(wire, values));
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace levitas::can
