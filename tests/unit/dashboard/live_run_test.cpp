#include "dashboard/live_run.hpp"

#include <gtest/gtest.h>

#include "announced_run.hpp"

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
