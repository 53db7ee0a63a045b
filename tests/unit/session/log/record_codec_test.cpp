#include "session/log/record_codec.hpp"

#include <gtest/gtest.h>

#include "common/crc32.hpp"
#include "session/log/log_format.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;

void Sign(Bytes& bytes) {
  std::fill(bytes.end() - 4, bytes.end(), std::uint8_t{0});
  PutBigEndian(bytes.data() + bytes.size() - 4, Crc32(bytes.data(), bytes.size()));
}

class Codec : public ::testing::Test {
 protected:
  void SetUp() override { codec_.Encode(record_, bytes_); }
  Random draw_{9};
  cycle::CycleRecord record_{DrawRecord(draw_, 5)};
  RecordCodec codec_{4};
  Bytes bytes_;
};

TEST_F(Codec, CrcIsTheOneOfTheBytesWithItsFieldZero) {
  Bytes signed_again = bytes_;
  Sign(signed_again);
  EXPECT_EQ(signed_again, bytes_);
}

TEST_F(Codec, NoSingleFlippedBitDecodes) {
  const cycle::CycleRecord untouched = record_;
  cycle::CycleRecord read = untouched;
  for (std::size_t bit = 0; bit < bytes_.size() * 8; ++bit) {
    bytes_[bit / 8] = static_cast<std::uint8_t>(bytes_[bit / 8] ^ (1U << (bit % 8)));
    ASSERT_FALSE(codec_.Decode(bytes_, read)) << "bit " << bit;
    bytes_[bit / 8] = static_cast<std::uint8_t>(bytes_[bit / 8] ^ (1U << (bit % 8)));
  }
  EXPECT_TRUE(SameBits(read, untouched));
}

TEST_F(Codec, NoShorterOrLongerPieceDecodes) {
  cycle::CycleRecord read;
  for (std::size_t size = 0; size < bytes_.size(); ++size) {
    EXPECT_FALSE(codec_.Decode(std::span(bytes_).first(size), read)) << size;
  }
  bytes_.push_back(0);
  EXPECT_FALSE(codec_.Decode(bytes_, read));
}

TEST_F(Codec, AxisCountBeyondTheCapacityIsRefusedEvenWithAGoodCrc) {
  cycle::CycleRecord read;
  for (const std::int32_t axes : {9, -1, 1'000'000'000}) {
    Bytes bytes = bytes_;
    PutBigEndian(bytes.data() + 16, axes);
    Sign(bytes);
    EXPECT_FALSE(codec_.Decode(bytes, read)) << axes;
  }
}

TEST_F(Codec, WordsBeyondTheirTablesAreRefusedEvenWithAGoodCrc) {
  const auto decodes = [this](const cycle::CycleRecord& record) {
    codec_.Encode(record, bytes_);
    cycle::CycleRecord read;
    return codec_.Decode(bytes_, read);
  };
  for (int word = 0; word < 256; ++word) {
    cycle::CycleRecord record = record_;
    record.out.mode = static_cast<Mode>(word);
    EXPECT_EQ(decodes(record), word < kModeCount) << "mode " << word;
    record = record_;
    record.out.fault = static_cast<Fault>(word);
    EXPECT_EQ(decodes(record), word < kFaultCount) << "fault " << word;
    record = record_;
    record.in.op.command = static_cast<OperatorCommand>(word);
    EXPECT_EQ(decodes(record), word < kOperatorCommandCount) << "command " << word;
  }
}

TEST_F(Codec, EveryAxisCountUpToTheCapacitySurvives) {
  for (std::uint32_t axes = 0; axes <= kMaxAxes; ++axes) {
    cycle::CycleRecord record = DrawRecord(draw_, axes);
    for (AxisArray* values :
         {&record.in.frame.position_m, &record.in.op.excitation_a, &record.in.op.excitation_m,
          &record.out.reference_m, &record.out.current.control_current_a}) {
      *values = DrawAxes(draw_, 1.0, axes);
    }
    RecordCodec writer(axes);
    writer.Encode(record, bytes_);
    cycle::CycleRecord read;
    ASSERT_TRUE(codec_.Decode(bytes_, read)) << axes;
    EXPECT_TRUE(SameBits(read, record)) << axes;
  }
}

TEST(EventCodec, RefusesWordsAndLengthsThatAreNone) {
  Event event;
  event.text = "the rotor is too fast";
  Bytes bytes;
  EncodeEvent(event, bytes);
  Event read;
  ASSERT_TRUE(DecodeEvent(bytes, read));
  EXPECT_EQ(read.text, event.text);
  constexpr std::size_t kSeverity = 24;
  for (const std::size_t at : {kSeverity, kSeverity + 1, kSeverity + 2}) {
    Bytes bad = bytes;
    bad[at] = 100;
    EXPECT_FALSE(DecodeEvent(bad, read)) << at;
  }
  Bytes bad = bytes;
  PutBigEndian<std::int32_t>(bad.data() + 44, 0x7FFFFFFF);
  EXPECT_FALSE(DecodeEvent(bad, read));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(DecodeEvent(std::span(bytes).first(size), read)) << size;
  }
}

TEST(HeaderCodec, TellsDamageFromAnotherVersion) {
  Bytes bytes;
  EncodeHeader(Header(), bytes);
  SessionHeader read;
  int version = 0;
  EXPECT_EQ(DecodeHeader(bytes, read, version), HeaderResult::kGood);
  Bytes other = bytes;
  PutBigEndian<std::int32_t>(other.data() + 8, 7);
  EXPECT_EQ(DecodeHeader(other, read, version), HeaderResult::kDamaged);  // a flipped bit
  Sign(other);
  EXPECT_EQ(DecodeHeader(other, read, version), HeaderResult::kOtherVersion);
  EXPECT_EQ(version, 7);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_EQ(DecodeHeader(std::span(bytes).first(size), read, version), HeaderResult::kDamaged);
  }
}

}  // namespace
}  // namespace levitas::session
