#include "lcmtypes/checked_decode.hpp"

#include <gtest/gtest.h>

#include "common/axes.hpp"
#include "common/histogram.hpp"
#include "common/random.hpp"
#include "common/torsion_batch.hpp"
#include "samples.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/sample_batcher.hpp"

namespace levitas::message {
namespace {

using namespace testing;

template <class Message>
class EveryType : public ::testing::Test {};

template <class Tuple>
struct AsTypes;
template <class... Messages>
struct AsTypes<std::tuple<Messages...>> {
  using Types = ::testing::Types<Messages...>;
};
TYPED_TEST_SUITE(EveryType, AsTypes<EveryMessage>::Types);

TYPED_TEST(EveryType, DecodesToWhatWasEncoded) {
  const Bytes bytes = Encoded(Sample<TypeParam>());
  TypeParam read{};
  ASSERT_TRUE(DecodeChecked(bytes, read));
  EXPECT_EQ(Encoded(read), bytes);
}

TYPED_TEST(EveryType, RefusesEveryShorterPieceAndWhatIsLonger) {
  Bytes bytes = Encoded(Sample<TypeParam>());
  TypeParam read{};
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(DecodeChecked(std::span(bytes).first(size), read)) << size;
  }
  bytes.push_back(0);
  EXPECT_FALSE(DecodeChecked(bytes, read));
}

TYPED_TEST(EveryType, RefusesBytesOfAnotherType) {
  Bytes bytes = Encoded(Sample<TypeParam>());
  bytes[3] = static_cast<std::uint8_t>(bytes[3] ^ 1U);
  TypeParam read{};
  EXPECT_FALSE(DecodeChecked(bytes, read));
}

// Every word of four bytes is once made each of the numbers that break a believing decoder. What
// still fits must be a message: decoded and encoded anew it gives the same bytes.
TYPED_TEST(EveryType, WhatFitsIsAMessageWhateverItsWordsAre) {
  constexpr std::array<std::uint32_t, 8> kHostile{0,          1,          9,          17,
                                                  0x7fffffff, 0x80000000, 0xfffffffb, 0xffffffff};
  const Bytes bytes = Encoded(Sample<TypeParam>());
  for (std::size_t at = kHashBytes; at + 4 <= bytes.size(); ++at) {
    for (const std::uint32_t word : kHostile) {
      Bytes changed = bytes;
      for (std::size_t i = 0; i < 4; ++i) {
        changed[at + i] = static_cast<std::uint8_t>(word >> (8U * (3U - i)));
      }
      TypeParam read{};
      if (!DecodeChecked(changed, read)) continue;
      ASSERT_EQ(Encoded(read), changed) << at << ' ' << word;
    }
  }
}

TYPED_TEST(EveryType, WhatFitsIsAMessageAfterRandomChanges) {
  const Bytes bytes = Encoded(Sample<TypeParam>());
  Random draw{20261123};
  for (int count = 0; count < 20'000; ++count) {
    Bytes changed = bytes;
    for (std::size_t change = 0; change <= draw.Bits() % 4; ++change) {
      const std::size_t at = kHashBytes + draw.Bits() % (changed.size() - kHashBytes);
      changed[at] = static_cast<std::uint8_t>(draw.Bits() % 3 == 0 ? draw.Bits() : draw.Bits() % 6);
    }
    if (draw.Bits() % 4 == 0) changed.resize(changed.size() + draw.Bits() % 32, 0);
    TypeParam read{};
    if (!DecodeChecked(changed, read)) continue;
    ASSERT_EQ(Encoded(read).size(), changed.size());
  }
}

template <class Message>
bool Accepted(const Message& message) {
  Message read{};
  return DecodeChecked(Encoded(message), read);
}

TEST(CheckedDecode, TakesTheLargestCountAndRefusesOneMore) {
  auto state = Sample<levitas_msg::controller_state_t>();
  const auto resize = [&state](int axes) {
    state.axes = axes;
    const auto count = static_cast<std::size_t>(axes);
    for (auto* values : {&state.position_m, &state.reference_m, &state.control_current_a}) {
      values->resize(count);
    }
  };
  resize(8);
  EXPECT_TRUE(Accepted(state));
  resize(9);
  EXPECT_FALSE(Accepted(state));
  auto header = Sample<levitas_msg::session_header_t>();
  header.channels = 8;
  header.channel.resize(8);
  EXPECT_TRUE(Accepted(header));
  header.channels = 9;
  header.channel.resize(9);
  EXPECT_FALSE(Accepted(header));
}

TEST(CheckedDecode, RefusesATextWithAZeroInsideOrWithoutItsZero) {
  auto event = Sample<levitas_msg::event_t>();
  event.text = "a b";
  Bytes bytes = Encoded(event);
  levitas_msg::event_t read{};
  ASSERT_TRUE(DecodeChecked(bytes, read));
  bytes.back() = 'c';
  EXPECT_FALSE(DecodeChecked(bytes, read));
  bytes.back() = 0;
  bytes[bytes.size() - 3] = 0;
  EXPECT_FALSE(DecodeChecked(bytes, read));
}

/// The @max of the counts of a type, in their order.
template <class Message>
std::vector<std::size_t> Limits() {
  std::vector<std::size_t> limits;
  for (const Piece& piece : kLayout<Message>) {
    if (piece.kind == Piece::Kind::kCount) limits.push_back(piece.max);
  }
  return limits;
}

TEST(CheckedDecode, LimitsOfTheMessagesAreThoseOfTheProgram) {
  using Counts = std::vector<std::size_t>;
  EXPECT_EQ(Limits<levitas_msg::controller_state_t>(), Counts{kMaxAxes});
  EXPECT_EQ(Limits<levitas_msg::current_frame_t>(), Counts{kMaxAxes});
  EXPECT_EQ(Limits<levitas_msg::sensor_frame_t>(), Counts{kMaxAxes});
  EXPECT_EQ(Limits<levitas_msg::session_header_t>(), Counts{kMaxAxes});
  EXPECT_EQ(Limits<levitas_msg::cycle_record_t>(), (Counts{kMaxAxes, 2 * kMaxAxes}));
  EXPECT_EQ(Limits<levitas_msg::loop_histogram_t>(), Counts{Histogram::kBins});
  EXPECT_EQ(Limits<levitas_msg::torsion_batch_t>(), Counts{kMaxCouplings * kTorsionSamples});
  const Counts batch = Limits<levitas_msg::sample_batch_t>();
  EXPECT_GE(batch[0], transport::SampleBatcher::kBatch);
  EXPECT_EQ(batch[1], batch[0] * kMaxAxes);
  // Two axes in two lists, speed and angle, as floats: more never fits into one datagram.
  EXPECT_GE(batch[0], transport::kMaxDatagram / ((2 * 2 + 2) * sizeof(float)));
}

}  // namespace
}  // namespace levitas::message
