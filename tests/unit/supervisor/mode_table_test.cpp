#include "controller/supervisor/mode_table.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "tests/support/paths.hpp"
#include "tests/unit/supervisor/supervisor_rig.hpp"

namespace levitas::supervisor {
namespace {

template <class Enum>
Enum At(std::size_t i) {
  return static_cast<Enum>(i);
}

TEST(ModeTable, HoldsEachPairOfStateAndEventOnce) {
  std::set<std::pair<State, Event>> seen;
  for (const Edge& edge : kEdges) EXPECT_TRUE(seen.emplace(edge.from, edge.event).second);
}

TEST(ModeTable, ListsEveryStateAtItsOwnPlace) {
  for (std::size_t i = 0; i < kStateCount; ++i) EXPECT_EQ(kStates[i].state, At<State>(i));
}

TEST(ModeTable, ShowsEveryMode) {
  std::set<Mode> shown;
  for (const StateRow& row : kStates) shown.insert(row.mode);
  EXPECT_EQ(shown.size(), kModeCount);
}

TEST(ModeTable, ReachesEveryStateFromOffAndOffFromEveryState) {
  for (std::size_t start = 0; start < kStateCount; ++start) {
    std::set<State> reached{At<State>(start)};
    for (std::size_t pass = 0; pass < kStateCount; ++pass) {
      for (const Edge& edge : kEdges) {
        if (reached.contains(edge.from)) reached.insert(edge.to);
      }
    }
    EXPECT_EQ(reached.size(), kStateCount) << Name(At<State>(start));
  }
}

TEST(ModeTable, TripNeedsAResetBeforeItLiftsAgain) {
  for (const Edge& edge : kEdges) {
    if (Row(edge.from).mode != Mode::kTripped || Row(edge.to).mode == Mode::kTripped) continue;
    EXPECT_EQ(edge.event, Event::kCommandReset);
    EXPECT_EQ(edge.guard, Guard::kCauseGone);
    EXPECT_EQ(edge.to, State::kOff);
  }
}

TEST(ModeTable, ADropFaultDeEnergisesFromEveryEnergisedState) {
  for (const StateRow& row : kStates) {
    if (!row.energised) continue;
    const Edge* const edge = FindEdge(row.state, Event::kDropFault);
    ASSERT_NE(edge, nullptr) << Name(row.state);
    EXPECT_EQ(edge->guard, Guard::kAlways);
    EXPECT_FALSE(Row(edge->to).energised);
  }
}

TEST(ModeTable, AStopFaultKeepsARotorThatMayTurnLevitatedAndBrakesIt) {
  for (const State state :
       {State::kLevitating, State::kSpinning, State::kCoastDown, State::kLanding}) {
    const Edge* const edge = FindEdge(state, Event::kStopFault);
    ASSERT_NE(edge, nullptr);
    EXPECT_TRUE(Row(edge->to).energised);
    EXPECT_EQ(Row(edge->to).drive, Drive::kBrake);
  }
}

TEST(ModeTable, LooksForSignalFaultsWhereverCurrentFlows) {
  for (const StateRow& row : kStates) {
    if (row.energised) {
      EXPECT_EQ(row.armed & kSignalFaults, kSignalFaults) << Name(row.state);
    }
  }
}

// On its way up the rotor comes from the touchdown bearing; else it follows its reference.
TEST(ModeTable, ArmsTheOrbitWhereverTheRotorIsHeldExceptDuringTheLift) {
  for (const StateRow& row : kStates) {
    const bool armed = (row.armed & Bit(Fault::kOrbitExceeded)) != 0;
    EXPECT_EQ(armed, row.energised && row.state != State::kLift) << Name(row.state);
  }
}

TEST(ModeTable, LetsNoExcitationThroughInATrip) {
  for (const StateRow& row : kStates) {
    if (row.mode == Mode::kTripped || !row.energised) {
      EXPECT_FALSE(row.excitation);
    }
  }
}

// The whole matrix of states and commands, written out by hand: what each leads to; '.' = refused.
TEST(ModeTable, AcceptsExactlyTheseCommands) {
  const std::map<State, std::array<std::string_view, 5>> expected = {
      //                          lift         spin        coast_down    land       reset
      {State::kOff, {"self_test", ".", ".", ".", "."}},
      {State::kSelfTest, {".", ".", ".", "off", "."}},
      {State::kLift, {".", ".", ".", "landing", "."}},
      {State::kLevitating, {".", "spinning", ".", "landing", "."}},
      {State::kSpinning, {".", "spinning", "coast_down", ".", "."}},
      {State::kCoastDown, {".", "spinning", "coast_down", ".", "."}},
      {State::kLanding, {".", ".", ".", ".", "."}},
      {State::kTrippedStopping, {".", ".", ".", ".", "."}},
      {State::kTrippedLanding, {".", ".", ".", ".", "."}},
      {State::kTrippedReleased, {".", ".", ".", ".", "off"}},
  };
  constexpr std::array kCommands{OperatorCommand::kLift, OperatorCommand::kSpin,
                                 OperatorCommand::kCoastDown, OperatorCommand::kLand,
                                 OperatorCommand::kReset};
  ASSERT_EQ(expected.size(), kStateCount);
  for (const auto& [state, row] : expected) {
    for (std::size_t i = 0; i < kCommands.size(); ++i) {
      Driver driver;
      driver.GoTo(state);
      ASSERT_EQ(driver.state(), state);
      const Decision& decision = driver.Step(kCommands[i]);
      const bool refused = row[i] == ".";
      EXPECT_EQ(decision.command_refused, refused)
          << Name(state) << " " << levitas::Name(kCommands[i]);
      EXPECT_EQ(Name(decision.state), refused ? Name(state) : row[i])
          << Name(state) << " " << levitas::Name(kCommands[i]);
    }
  }
}

TEST(ModeTable, LetsATestSignalBeginOnlyWhereCurrentsAreInjectedAndAlwaysLetsItEnd) {
  const std::set<State> passing{State::kLevitating, State::kSpinning, State::kCoastDown};
  for (std::size_t i = 0; i < kStateCount; ++i) {
    const State state = At<State>(i);
    for (const auto command :
         {OperatorCommand::kExcite, OperatorCommand::kEndExcitation, OperatorCommand::kMark}) {
      Driver driver;
      driver.GoTo(state);
      const Decision& decision = driver.Step(command);
      EXPECT_EQ(decision.command_refused,
                command == OperatorCommand::kExcite && !passing.contains(state))
          << Name(state) << " " << levitas::Name(command);
      EXPECT_EQ(decision.state, state) << levitas::Name(command);
    }
  }
}

TEST(ModeTable, TakesAnEmergencyStopInEveryStateAndNeverRefusesIt) {
  for (std::size_t i = 0; i < kStateCount; ++i) {
    Driver driver;
    driver.GoTo(At<State>(i));
    const Decision& decision = driver.Step(OperatorCommand::kEmergencyStop);
    EXPECT_EQ(Row(decision.state).mode, Mode::kTripped) << Name(At<State>(i));
    EXPECT_EQ(decision.latch.finding.fault, Fault::kEmergencyStop);
    EXPECT_FALSE(decision.command_refused);
  }
}

TEST(ModeTable, HasItsOwnNameForEverything) {
  const auto distinct = [](auto first, std::size_t count) {
    using Enum = decltype(first);
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < count; ++i) names.insert(Name(At<Enum>(i)));
    EXPECT_EQ(names.size(), count);
    EXPECT_FALSE(names.contains("invalid"));
    EXPECT_EQ(Name(At<Enum>(count)), "invalid");
  };
  distinct(State{}, kStateCount);
  distinct(Event{}, kEventCount);
  distinct(Guard{}, 5);
  distinct(Action{}, 5);
  distinct(Reference{}, 4);
  distinct(Drive{}, 3);
}

TEST(ModesDocument, IsWhatTheTableSays) {
  const std::string path = levitas::test::SourceFolder() + "/docs/safety.md";
  std::ifstream file(path);
  std::ostringstream whole;
  whole << file.rdbuf();
  const std::size_t chapter = whole.str().find("## Modes\n");
  ASSERT_NE(chapter, std::string::npos) << path << " has no chapter \"Modes\"";
  const std::string before = whole.str().substr(0, chapter);
  if (std::getenv("LEVITAS_WRITE_DOCS") != nullptr) {
    std::ofstream(path) << before << ModeTableDocument();
  } else {
    EXPECT_EQ(whole.str().substr(chapter), ModeTableDocument())
        << "LEVITAS_WRITE_DOCS=1 makes this test write the chapter of " << path << " anew";
  }
}

}  // namespace
}  // namespace levitas::supervisor
