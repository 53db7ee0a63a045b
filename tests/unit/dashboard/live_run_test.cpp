#include "dashboard/live_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "announced_run.hpp"
#include "common/crc32.hpp"
#include "session/log/log_format.hpp"

namespace levitas::dashboard {
namespace {

namespace channel = transport::channel;

TEST(LiveRun, LearnsTheRigFromTheNetwork) {
  LiveRun run;
  EXPECT_FALSE(run.rig());
  run.Take(channel::kHeader, EncodedHeader(1), 0);
  ASSERT_TRUE(run.rig());
  EXPECT_EQ(run.rig()->name, "flexible_rotor");
  EXPECT_EQ(run.run_number(), 1U);
  EXPECT_TRUE(run.samples());
}

TEST(LiveRun, TakesARepeatedHeaderForTheSameRunAndALaterOneForAnother) {
  LiveRun run;
  run.Take(channel::kHeader, EncodedHeader(1), 0);
  run.Take(channel::kState, Encoded(TrippedState()), 5);
  run.Take(channel::kHeader, EncodedHeader(1), 10);
  EXPECT_EQ(run.run_number(), 1U);
  EXPECT_TRUE(run.state());
  run.Take(channel::kHeader, EncodedHeader(2), 20);
  EXPECT_EQ(run.run_number(), 2U);
  EXPECT_FALSE(run.state()) << "the state of the run before says nothing of this one";
}

TEST(LiveRun, CountsAndDropsWhatItCannotRead) {
  LiveRun run;
  const std::vector<std::uint8_t> noise(40, 0xA5);
  for (const char* name : {channel::kHeader, channel::kState, channel::kTiming, channel::kHistogram,
                           channel::kEvent}) {
    run.Take(name, noise, 0);
    run.Take(name, {}, 0);
  }
  EXPECT_EQ(run.refused(), 10U);
  EXPECT_FALSE(run.rig());
  EXPECT_FALSE(run.state());
  run.Take("SOMETHING_ELSE", noise, 0);
  EXPECT_EQ(run.refused(), 10U) << "other channels are none of its business";
}

// Counts and lengths that LCM's own decoder believes: it would throw, or ask for gigabytes.
TEST(LiveRun, RefusesAHeaderWhoseLengthsLieAlthoughItsChecksumIsRight) {
  const session::Bytes good = EncodedHeader(1);
  constexpr std::size_t kFirstTextAt = 8 + 4;               // behind hash and format_version
  const std::size_t channels_at = good.size() - 4 - 5 - 4;  // before an empty text and the CRC
  LiveRun run;
  for (const std::size_t at : {kFirstTextAt, channels_at}) {
    for (const std::uint32_t lie : {0U, 1000U, 0x7fffffffU, 0x80000000U, 0xfffffffbU}) {
      session::Bytes bytes = good;
      session::PutBigEndian(bytes.data() + at, lie);
      if (bytes == good) continue;  // it has no channels: 0 is the truth
      std::fill(bytes.end() - 4, bytes.end(), std::uint8_t{0});
      session::PutBigEndian(bytes.data() + bytes.size() - 4, Crc32(bytes.data(), bytes.size()));
      run.Take(channel::kHeader, bytes, 0);
      EXPECT_FALSE(run.rig()) << "at " << at << ": " << lie;
    }
  }
  EXPECT_EQ(run.refused(), 9U);
  run.Take(channel::kHeader, good, 0);
  EXPECT_TRUE(run.rig());
}

TEST(LiveRun, RefusesAStateOfMoreAxesThanItHolds) {
  constexpr std::size_t kAxesAt = 8 + 8 + 8 + 3;
  for (const std::uint32_t lie : {1U, 9U, 0x7fffffffU, 0xffffffffU}) {
    auto bytes = Encoded(TrippedState());
    session::PutBigEndian(bytes.data() + kAxesAt, lie);
    LiveRun run;
    run.Take(channel::kState, bytes, 0);
    EXPECT_FALSE(run.state()) << lie;
    EXPECT_EQ(run.refused(), 1U) << lie;
  }
}

TEST(LiveRun, NumbersEventsAndKeepsTheLatest) {
  LiveRun run;
  run.Take(channel::kHeader, EncodedHeader(1), 0);
  session::Bytes bytes;
  session::EncodeEvent({.cycle = 20'000, .text = "something"}, bytes);
  for (std::size_t i = 0; i < LiveRun::kMaxEvents + 5; ++i) run.Take(channel::kEvent, bytes, 0);
  EXPECT_EQ(run.events().size(), LiveRun::kMaxEvents);
  EXPECT_EQ(run.newest_event(), LiveRun::kMaxEvents + 5);
  EXPECT_EQ(run.events().front().number, 6U);
  EXPECT_DOUBLE_EQ(run.events().back().time_s, 2.0);  // 20 000 cycles of 100 us
}

}  // namespace
}  // namespace levitas::dashboard
