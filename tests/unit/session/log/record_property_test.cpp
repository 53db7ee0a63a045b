// The codec for records that no machine would produce: every field takes the extreme values of its
// type, for every axis count.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "session/log/record_codec.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;

/// Any number of a type, its ends as often as what lies between.
template <class Whole>
Whole AnyWhole(Random& draw) {
  switch (draw.Bits() % 4) {
    case 0:
      return std::numeric_limits<Whole>::max();
    case 1:
      return std::numeric_limits<Whole>::min();
    default:
      return static_cast<Whole>(draw.Bits());
  }
}

/// Any bit pattern of a double: NaNs with a payload, infinities, both zeros, subnormal numbers.
double AnyDouble(Random& draw) {
  using Limits = std::numeric_limits<double>;
  static constexpr std::array kSpecial{0.0,
                                       -0.0,
                                       Limits::denorm_min(),
                                       -Limits::min(),
                                       Limits::max(),
                                       Limits::lowest(),
                                       Limits::infinity(),
                                       -Limits::infinity(),
                                       Limits::quiet_NaN()};
  const std::uint64_t bits = draw.Bits();
  return bits % 2 == 0 ? kSpecial[bits / 2 % kSpecial.size()] : std::bit_cast<double>(draw.Bits());
}

bool AnyBool(Random& draw) { return draw.Bits() % 2 == 0; }

AxisArray AnyAxes(Random& draw, std::uint32_t axes) {
  AxisArray values{};
  for (std::uint32_t axis = 0; axis < axes; ++axis) values[axis] = AnyDouble(draw);
  return values;
}

cycle::CycleRecord AnyRecord(Random& draw, std::uint32_t axes) {
  cycle::CycleRecord record;
  auto& in = record.in;
  in.cycle = AnyWhole<std::uint64_t>(draw);
  in.frame_present = AnyBool(draw);
  in.frame = {.cycle = AnyWhole<std::uint64_t>(draw),
              .sample_time_ns = AnyWhole<std::int64_t>(draw),
              .rig_session = AnyWhole<std::uint32_t>(draw),
              .rig_status = AnyWhole<std::uint32_t>(draw),
              .held_currents = AnyWhole<std::uint32_t>(draw),
              .axes = AnyWhole<std::uint32_t>(draw),
              .position_m = AnyAxes(draw, axes),
              .speed_rad_per_s = AnyDouble(draw),
              .angle_rad = AnyDouble(draw)};
  in.missed_deadlines = AnyWhole<std::uint32_t>(draw);
  in.op = {.command = static_cast<OperatorCommand>(draw.Bits() % kOperatorCommandCount),
           .speed_rad_per_s = AnyDouble(draw),
           .acceleration_rad_per_s2 = AnyDouble(draw),
           .excitation_a = AnyAxes(draw, axes)};
  auto& out = record.out;
  out.current = {.cycle = AnyWhole<std::uint64_t>(draw),
                 .axes = AnyWhole<std::uint32_t>(draw),
                 .control_current_a = AnyAxes(draw, axes),
                 .bias_current_a = AnyDouble(draw),
                 .speed_set_point_rad_per_s = AnyDouble(draw),
                 .acceleration_limit_rad_per_s2 = AnyDouble(draw),
                 .amplifiers_enabled = AnyBool(draw),
                 .drive_enabled = AnyBool(draw)};
  out.reference_m = AnyAxes(draw, axes);
  out.saturated_axes = AnyWhole<std::uint16_t>(draw);
  out.mode = static_cast<Mode>(draw.Bits() % kModeCount);
  out.fault = static_cast<Fault>(draw.Bits() % kFaultCount);
  out.fault_axis = AnyWhole<std::int8_t>(draw);
  out.fault_value = AnyDouble(draw);
  out.fault_limit = AnyDouble(draw);
  out.command_refused = AnyBool(draw);
  return record;
}

class AnyRecords : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(AnyRecords, ComeBackBitForBit) {
  const std::uint32_t axes = GetParam();
  Random draw{1000 + axes};
  RecordCodec codec(axes);
  RecordCodec reader(kMaxAxes);  // a reader does not know the axis count beforehand
  Bytes bytes;
  Bytes again;
  for (int round = 0; round < 2000; ++round) {
    const cycle::CycleRecord record = AnyRecord(draw, axes);
    codec.Encode(record, bytes);
    cycle::CycleRecord read = AnyRecord(draw, kMaxAxes);  // nothing of before may shine through
    ASSERT_TRUE(reader.Decode(bytes, read)) << round;
    ASSERT_TRUE(SameBits(read, record)) << round;
    codec.Encode(read, again);
    ASSERT_EQ(again, bytes) << round;
  }
}

TEST_P(AnyRecords, HaveOneLengthWhateverTheyHold) {
  const std::uint32_t axes = GetParam();
  Random draw{2000 + axes};
  RecordCodec codec(axes);
  std::set<std::size_t> lengths;
  Bytes bytes;
  for (int round = 0; round < 100; ++round) {
    codec.Encode(AnyRecord(draw, axes), bytes);
    lengths.insert(bytes.size());
  }
  EXPECT_EQ(lengths.size(), 1U);
}

TEST_P(AnyRecords, WithOneFlippedBitAreRefusedAndLeaveTheTargetAlone) {
  const std::uint32_t axes = GetParam();
  Random draw{3000 + axes};
  RecordCodec codec(axes);
  Bytes bytes;
  for (int round = 0; round < 3; ++round) {
    codec.Encode(AnyRecord(draw, axes), bytes);
    const cycle::CycleRecord before = AnyRecord(draw, axes);
    cycle::CycleRecord read = before;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      const auto mask = static_cast<std::uint8_t>(1U << (bit % 8));
      bytes[bit / 8] ^= mask;
      ASSERT_FALSE(codec.Decode(bytes, read)) << "round " << round << ", bit " << bit;
      bytes[bit / 8] ^= mask;
    }
    ASSERT_TRUE(SameBits(read, before));
  }
}

// A CRC of 32 bits finds every burst of up to 32 bits (Peterson & Brown 1961), here four bytes
// inside the data; bytes that happen to be drawn as they were are no damage.
TEST_P(AnyRecords, WithAnyFourBytesOverwrittenAreRefused) {
  const std::uint32_t axes = GetParam();
  Random draw{4000 + axes};
  RecordCodec codec(axes);
  Bytes bytes;
  codec.Encode(AnyRecord(draw, axes), bytes);
  const Bytes good = bytes;
  cycle::CycleRecord read;
  for (std::size_t at = 0; at + 8 <= bytes.size(); ++at) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(draw.Bits());
    if (bytes != good) {
      ASSERT_FALSE(codec.Decode(bytes, read)) << at;
    }
    bytes = good;
  }
}

INSTANTIATE_TEST_SUITE_P(OfEveryAxisCount, AnyRecords, ::testing::Range(1U, 9U));

/// Letters, line ends, quotes, and bytes that are no UTF-8; no zero byte, which ends a text.
std::string AnyText(Random& draw) {
  std::string text(draw.Bits() % 200, '\0');
  for (char& c : text) c = static_cast<char>(1 + draw.Bits() % 255);
  return text;
}

TEST(AnyHeader, ComesBackWithEveryByteOfItsTexts) {
  Random draw{5};
  for (int round = 0; round < 500; ++round) {
    SessionHeader header;
    const std::array texts{&header.program_version, &header.rig_yaml,  &header.controller_yaml,
                           &header.scenario_yaml,   &header.pace,      &header.machine,
                           &header.source,          &header.excerpt_of};
    for (std::string* text : texts) *text = AnyText(draw);
    header.seed = AnyWhole<std::int64_t>(draw);
    header.period_ns = AnyWhole<std::int64_t>(draw);
    header.start_utc_ns = AnyWhole<std::int64_t>(draw);
    header.channels.resize(draw.Bits() % (kMaxAxes + 1));
    for (std::string& channel : header.channels) channel = AnyText(draw);

    Bytes bytes;
    EncodeHeader(header, bytes);
    SessionHeader read = Header();
    int version = 0;
    ASSERT_EQ(DecodeHeader(bytes, read, version), HeaderResult::kGood) << round;
    const std::array back{&read.program_version, &read.rig_yaml,  &read.controller_yaml,
                          &read.scenario_yaml,   &read.pace,      &read.machine,
                          &read.source,          &read.excerpt_of};
    for (std::size_t i = 0; i < texts.size(); ++i) ASSERT_EQ(*back[i], *texts[i]) << i;
    EXPECT_EQ(read.channels, header.channels);
    EXPECT_EQ(read.seed, header.seed);
    EXPECT_EQ(read.period_ns, header.period_ns);
    EXPECT_EQ(read.start_utc_ns, header.start_utc_ns);
  }
}

TEST(HeaderCodec, CutsATextAtAZeroByteAndStaysReadable) {
  SessionHeader header = Header();
  header.machine = std::string("before\0behind", 13);
  header.channels[1] = std::string("de\0y", 4);
  Bytes bytes;
  EncodeHeader(header, bytes);
  SessionHeader read;
  int version = 0;
  ASSERT_EQ(DecodeHeader(bytes, read, version), HeaderResult::kGood);
  EXPECT_EQ(read.machine, "before");
  EXPECT_EQ(read.channels[1], "de");
  EXPECT_EQ(read.rig_yaml, header.rig_yaml);
}

TEST(AnyEvent, ComesBackBitForBit) {
  Random draw{6};
  for (int round = 0; round < 500; ++round) {
    Event event;
    event.cycle = AnyWhole<std::uint64_t>(draw);
    event.time_ns = AnyWhole<std::int64_t>(draw);
    event.severity = static_cast<Event::Severity>(draw.Bits() % 3);
    event.mode = static_cast<Mode>(draw.Bits() % kModeCount);
    event.fault = static_cast<Fault>(draw.Bits() % kFaultCount);
    event.axis = AnyWhole<std::int8_t>(draw);
    event.value = AnyDouble(draw);
    event.limit = AnyDouble(draw);
    event.text = AnyText(draw);
    Bytes bytes;
    EncodeEvent(event, bytes);
    Event read;
    ASSERT_TRUE(DecodeEvent(bytes, read)) << round;
    EXPECT_EQ(read.cycle, event.cycle);
    EXPECT_EQ(read.time_ns, event.time_ns);
    EXPECT_EQ(read.severity, event.severity);
    EXPECT_EQ(read.mode, event.mode);
    EXPECT_EQ(read.fault, event.fault);
    EXPECT_EQ(read.axis, event.axis);
    EXPECT_TRUE(SameBits(read.value, event.value));
    EXPECT_TRUE(SameBits(read.limit, event.limit));
    EXPECT_EQ(read.text, event.text);
  }
}

}  // namespace
}  // namespace levitas::session
