// Random operators, rigs and ends: in every cycle the command arbiter answers what the reference
// does that was written from its headers.

#include "tests/unit/loop/desk_walk.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/loop/reference_desk.hpp"

namespace levitas::loop::test {
namespace {

TEST(DeskWalk, TheArbiterAnswersInEveryCycleWhatItsHeadersSay) {
  Met met;
  std::set<EndState> ends;
  std::set<SignalState> signals;
  const auto look = [&](const CommandArbiter& desk) {
    ends.insert(desk.end_state());
    signals.insert(desk.signal_state());
  };
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    ASSERT_NO_FATAL_FAILURE((Walk<CommandArbiter, ReferenceDesk>(seed, met, look)));
  }
  // Walks that go nowhere prove nothing.
  EXPECT_EQ(ends.size(), kEndStateCount);
  EXPECT_EQ(signals.size(), kSignalStateCount);
  for (std::uint8_t i = 0; i < kOperatorCommandCount; ++i) {
    EXPECT_GT(met.commands[i], 50U) << Name(static_cast<OperatorCommand>(i));
  }
  EXPECT_GT(met.done, 20U);
  EXPECT_GT(met.done_turning, 5U);
  EXPECT_GT(met.overdue, 5U);
  EXPECT_GT(met.brake_fails, 5U);
  EXPECT_GT(met.signal_cycles, 1000U);
  EXPECT_GT(met.reduced, 100U);
  RecordProperty("cycles", std::to_string(met.cycles));
}

}  // namespace
}  // namespace levitas::loop::test
