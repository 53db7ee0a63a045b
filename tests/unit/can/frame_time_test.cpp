// Worst-case frame times against the published formula for classical CAN and against bits counted
// by a stuffing machine of our own for CAN FD.

#include "hil/can/frame_time.hpp"

#include <gtest/gtest.h>

#include <array>

#include "hil/can/wire_frame.hpp"

namespace levitas::can {
namespace {

constexpr double kTenthOfMicrosecond = 0.05e-6;  // half of the last printed digit

struct Row {
  std::size_t bytes;
  double at_2, at_5, at_8;  // [us]
};
// Arbitration at 1 Mbit/s; figures of an independent calculation, one digit after the point.
constexpr std::array<Row, 5> kRows{{{8, 90.5, 56.6, 48.1},
                                    {12, 110.5, 64.6, 53.1},
                                    {16, 130.5, 72.6, 58.1},
                                    {24, 173.0, 89.6, 68.8},
                                    {64, 373.0, 169.6, 118.8}}};

TEST(FrameTime, OfClassicalEightBytesIs135Microseconds) {
  EXPECT_NEAR(WorstFrameSeconds(8, {1e6, 0.0}), 135e-6, 1e-12);
  EXPECT_NEAR(WorstFrameSeconds(0, {1e6, 0.0}), 55e-6, 1e-12);  // Davis et al. 2007: 55 + 10 n
}

TEST(FrameTime, OfClassicalFramesIs55Plus10BitsPerByte) {
  for (std::size_t bytes = 0; bytes <= 8; ++bytes) {
    EXPECT_NEAR(WorstFrameSeconds(bytes, {1e6, 0.0}),
                (55.0 + 10.0 * static_cast<double>(bytes)) * 1e-6, 1e-12);
  }
}

TEST(FrameTime, OfFdFramesIsThatOfTheTable) {
  for (const Row& row : kRows) {
    EXPECT_NEAR(WorstFrameSeconds(row.bytes, {1e6, 2e6}), row.at_2 * 1e-6, kTenthOfMicrosecond);
    EXPECT_NEAR(WorstFrameSeconds(row.bytes, {1e6, 5e6}), row.at_5 * 1e-6, kTenthOfMicrosecond);
    EXPECT_NEAR(WorstFrameSeconds(row.bytes, {1e6, 8e6}), row.at_8 * 1e-6,
                kTenthOfMicrosecond + 1e-9);
  }
}

TEST(FrameTime, GrowsWithThePayloadAndShrinksWithTheRate) {
  double before = 0.0;
  for (std::size_t bytes = 0; bytes <= kMaxPayload; ++bytes) {
    const std::size_t length = PayloadLength(bytes);
    const double time_s = WorstFrameSeconds(length, {1e6, 5e6});
    EXPECT_GE(time_s, before);
    EXPECT_LT(WorstFrameSeconds(length, {1e6, 8e6}), time_s);
    before = time_s;
  }
}

// The worst pattern starts with five equal bits and goes on with four of each kind: a stuff bit
// begins the next run. Counted bit by bit, as a controller does it.
int StuffBitsOfWorstPattern(int bits, int run_before) {
  int stuffed = 0;
  int run = run_before;
  for (int bit = 0; bit < bits; ++bit) {
    ++run;  // every data bit continues the run: the pattern is chosen so
    if (run == 5) {
      ++stuffed;
      run = 1;  // the stuff bit is the first of the next run
    }
  }
  return stuffed;
}

TEST(FrameTime, HoldsAsManyStuffBitsAsTheWorstPatternNeeds) {
  // Classical: from the start of frame to the checksum, 34 + 8n bits.
  for (int bytes = 0; bytes <= 8; ++bytes) {
    const int bits = 47 + 8 * bytes + StuffBitsOfWorstPattern(34 + 8 * bytes, 0);
    EXPECT_NEAR(WorstFrameSeconds(static_cast<std::size_t>(bytes), {1.0, 0.0}), bits, 1e-9);
  }
  // FD with equal rates: 22 + 8n bits are stuffed as one stretch; counting the two phases apart
  // may add one bit at their border, never miss one.
  for (const int bytes : {8, 12, 16}) {
    const int counted = 17 + 13 + 5 + 8 * bytes + 27 + StuffBitsOfWorstPattern(22 + 8 * bytes, 0);
    const double time_s = WorstFrameSeconds(static_cast<std::size_t>(bytes), {1.0, 1.0});
    EXPECT_GE(time_s, counted);
    EXPECT_LE(time_s, counted + 1);
  }
}

TEST(PayloadLength, IsTheSmallestThatTheFormatKnows) {
  constexpr std::array<std::uint8_t, 16> kLengths{0, 1,  2,  3,  4,  5,  6,  7,
                                                  8, 12, 16, 20, 24, 32, 48, 64};
  for (std::size_t bytes = 0; bytes <= kMaxPayload; ++bytes) {
    std::size_t smallest = 0;
    while (kLengths[smallest] < bytes) ++smallest;
    EXPECT_EQ(PayloadLength(bytes), kLengths[smallest]);
  }
}

}  // namespace
}  // namespace levitas::can
