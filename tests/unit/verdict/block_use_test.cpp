#include "verdict/block_use.hpp"

#include <gtest/gtest.h>

#include "session/log/block_events.hpp"

namespace levitas::verdict {
namespace {

using synchronous::Ending;

session::Event At(std::uint64_t cycle, std::string text) {
  session::Event event;
  event.cycle = cycle;
  event.text = std::move(text);
  return event;
}

TEST(BlockEvents, AreReadAsTheyAreWritten) {
  const std::string where = "at 1500 rpm (cycle 4711)";
  const auto begins = session::ReadBlockEvent(session::BlockBegins("low", where));
  ASSERT_TRUE(begins.has_value());
  EXPECT_EQ(begins->name, "low");
  EXPECT_TRUE(begins->begins);
  EXPECT_EQ(begins->why, "") << "its angle is measured";
  const auto estimated =
      session::ReadBlockEvent(session::BlockBegins("low", where, synchronous::AngleSource::kOrbit));
  ASSERT_TRUE(estimated.has_value());
  EXPECT_EQ(estimated->name, "low");
  EXPECT_EQ(estimated->why, "no mark on the shaft, its angle is estimated from the orbit");
  for (const Ending why :
       {Ending::kSpeed, Ending::kAngleLost, Ending::kAngleJumped, Ending::kSaturated,
        Ending::kOrbitGrew, Ending::kCurrentTooLarge, Ending::kNotLevitated}) {
    const auto ends = session::ReadBlockEvent(session::BlockEnds("a begins at b", where, why));
    ASSERT_TRUE(ends.has_value());
    EXPECT_EQ(ends->name, "a begins at b");
    EXPECT_FALSE(ends->begins);
    EXPECT_FALSE(ends->why.empty());
  }
}

TEST(BlockEvents, AreNoOtherSentences) {
  for (const char* text : {"", "trip: orbit exceeded", "synchronous control",
                           "law 2 of the schedule takes over from law 1 at 1580 rpm (cycle 3)"}) {
    EXPECT_FALSE(session::ReadBlockEvent(text).has_value()) << text;
  }
}

TEST(BlockUse, CountsHowLongEachBlockActedAndWhyItEnded) {
  const std::string where = "at 1500 rpm (cycle 1)";
  const std::vector<session::Event> events{
      At(20'000, session::BlockBegins("low", where)),
      At(25'000, "something else"),
      At(30'000, session::BlockEnds("low", where, Ending::kSpeed)),
      At(40'000, session::BlockBegins("high", where)),
      At(50'000, session::BlockBegins("low", where)),
      At(55'000, session::BlockEnds("low", where, Ending::kOrbitGrew))};
  const auto blocks = BlocksOf(events, 10'000, 70'000, 1e-4);
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[0].name, "low");
  EXPECT_NEAR(blocks[0].acted_s, 1.5, 1e-12);
  EXPECT_EQ(blocks[0].times, 2);
  EXPECT_EQ(blocks[0].last_end, "the orbit grew");
  EXPECT_NEAR(blocks[0].last_end_s, 4.5, 1e-12);
  EXPECT_NEAR(blocks[1].acted_s, 3.0, 1e-12) << "until the record ends";
  EXPECT_EQ(blocks[1].last_end, "");
}

TEST(BlockUse, KeepsAFailureThatALaterEndWouldHide) {
  const std::string where = "at 1500 rpm (cycle 1)";
  std::vector<session::Event> events{
      At(10'000, session::BlockBegins("low", where)),
      At(20'000, session::BlockEnds("low", where, Ending::kAngleJumped)),
      At(30'000, session::BlockBegins("low", where)),
      At(40'000, session::BlockEnds("low", where, Ending::kSpeed))};
  events[1].severity = session::Event::Severity::kWarning;
  const auto blocks = BlocksOf(events, 0, 50'000, 1e-4);
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks[0].last_end, "the speed left its window");
  EXPECT_EQ(blocks[0].failures, 1);
  EXPECT_EQ(blocks[0].last_failure, "the rotor's angle jumped");
}

TEST(BlockUse, NamesABlockThatNeverBegan) {
  const std::vector<std::string> names{"low"};
  const auto blocks = BlocksOf({}, 0, 1000, 1e-4, names);
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks[0].name, "low");
  EXPECT_EQ(blocks[0].times, 0);
}

TEST(BlockUse, IsNothingWithoutBlocks) { EXPECT_TRUE(BlocksOf({}, 0, 1000, 1e-4).empty()); }

}  // namespace
}  // namespace levitas::verdict
