// The tables of the end of a run and of the remote test signal, and the chapter written from them.

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "controller/loop/arbiter_document.hpp"
#include "controller/loop/end_of_run.hpp"
#include "controller/loop/end_table.hpp"
#include "controller/loop/signal_table.hpp"
#include "controller/supervisor/mode_table.hpp"
#include "tests/support/paths.hpp"

namespace levitas::loop {
namespace {

template <class Enum>
Enum At(std::size_t i) {
  return static_cast<Enum>(i);
}

/// States to which `edges` lead from `start`, itself included.
template <class State, class Edges>
std::set<State> Reached(State start, const Edges& edges) {
  std::set<State> reached{start};
  for (std::size_t pass = 0; pass < edges.size(); ++pass) {
    for (const auto& edge : edges) {
      if (reached.contains(edge.from)) reached.insert(edge.to);
    }
  }
  return reached;
}

template <class Enum>
void ExpectDistinctNames(std::size_t count) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < count; ++i) names.insert(Name(At<Enum>(i)));
  EXPECT_EQ(names.size(), count);
  EXPECT_FALSE(names.contains("invalid"));
  EXPECT_EQ(Name(At<Enum>(count)), "invalid");
}

TEST(EndTable, HoldsEachPairOfStateAndEventOnceAndEachStateAtItsPlace) {
  std::set<std::pair<EndState, EndEvent>> seen;
  for (const EndEdge& edge : kEndEdges) EXPECT_TRUE(seen.emplace(edge.from, edge.event).second);
  for (std::size_t i = 0; i < kEndStateCount; ++i) EXPECT_EQ(kEndStates[i].state, At<EndState>(i));
}

TEST(EndTable, ReachesDoneFromEveryStateAndLeavesItNever) {
  EXPECT_EQ(Reached(EndState::kServing, kEndEdges).size(), kEndStateCount);
  for (std::size_t i = 0; i < kEndStateCount; ++i) {
    EXPECT_TRUE(Reached(At<EndState>(i), kEndEdges).contains(EndState::kDone));
  }
  EXPECT_EQ(Reached(EndState::kDone, kEndEdges).size(), 1U);
}

TEST(EndTable, ServesUntilTheEndBeginsAndNeverAgain) {
  for (const EndEdge& edge : kEndEdges) {
    EXPECT_FALSE(Row(edge.to).serves) << Name(edge.from) << " " << Name(edge.event);
  }
  EXPECT_TRUE(Row(EndState::kServing).serves);
}

// Every request may be refused, so each waits for its time and is made again.
TEST(EndTable, MakesNoRequestInEveryCycleAndNoneOfARotorThatWasLetGo) {
  for (const EndEdge& edge : kEndEdges) {
    const bool asks = edge.action == EndAction::kAskBrake ||
                      edge.action == EndAction::kAskLanding || edge.action == EndAction::kAskStop;
    EXPECT_EQ(asks, edge.guard == EndGuard::kRequestDue) << Name(edge.from) << Name(edge.event);
    if (asks) {
      EXPECT_NE(edge.from, EndState::kAwaitingStandstill);
    }
  }
}

// The whole matrix, written out by hand: what each event leads to with every guard; '.': nothing.
TEST(EndTable, LeadsWhereTheHeaderSays) {
  constexpr EndGuards kAll{.request_due = true, .recorded = true};
  const std::map<EndState, std::array<std::string_view, kEndEventCount>> expected = {
      {EndState::kServing,
       {"ending", "ending", "ending", ".", ".", ".", ".", ".", ".", ".", ".", "."}},
      {EndState::kEnding,
       {".", ".", ".", "awaiting_standstill", ".", ".", "ending ask_stop", ".",
        "ending ask_landing", "braking ask_brake", "braking ask_brake", "."}},
      {EndState::kBraking,
       {".", ".", ".", "awaiting_standstill", ".", ".", "braking ask_stop", ".",
        "braking ask_landing", ".", "braking ask_brake", "."}},
      {EndState::kAwaitingStandstill,
       {".", ".", ".", ".", "ending", ".", ".", ".", "done", ".", ".", "done"}},
      {EndState::kDone, {".", ".", ".", ".", ".", ".", ".", ".", ".", ".", ".", "."}},
  };
  for (const auto& [state, row] : expected) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const EndStep step = Advance(state, At<EndEvent>(i), kAll);
      std::string found(Name(step.to));
      if (step.action >= EndAction::kAskBrake && step.action <= EndAction::kAskStop) {
        found.append(" ").append(Name(step.action));
      } else if (step.to == state && step.action == EndAction::kNone) {
        found = ".";
      }
      EXPECT_EQ(found, row[i]) << Name(state) << " " << Name(At<EndEvent>(i));
    }
  }
}

TEST(EndTable, TakesNoEdgeWhoseGuardDoesNotHold) {
  for (const EndEdge& edge : kEndEdges) {
    if (edge.guard == EndGuard::kAlways) continue;
    const EndStep step = Advance(edge.from, edge.event, {});
    EXPECT_EQ(step.to, edge.from);
    EXPECT_EQ(step.action, EndAction::kNone);
  }
}

// Why an end that found the rotor let go waits for nothing but its standstill.
TEST(EndTable, NothingThatAnEndAsksForEnergisesARotorThatWasLetGo) {
  std::vector<supervisor::Edge> left;
  for (const supervisor::Edge& edge : supervisor::kEdges) {
    if (edge.event != supervisor::Event::kCommandLift &&
        edge.event != supervisor::Event::kCommandReset) {
      left.push_back(edge);
    }
  }
  for (const auto state : {supervisor::State::kOff, supervisor::State::kTrippedReleased}) {
    for (const auto reached : Reached(state, left)) {
      EXPECT_FALSE(supervisor::Row(reached).energised) << supervisor::Name(reached);
    }
  }
}

TEST(SignalTable, HoldsEachPairOfStateAndEventOnceAndEachStateAtItsPlace) {
  std::set<std::pair<SignalState, SignalEvent>> seen;
  for (const SignalEdge& edge : kSignalEdges) {
    EXPECT_TRUE(seen.emplace(edge.from, edge.event).second);
  }
  for (std::size_t i = 0; i < kSignalStateCount; ++i) {
    EXPECT_EQ(kSignalStates[i].state, At<SignalState>(i));
    EXPECT_EQ(Reached(At<SignalState>(i), kSignalEdges).size(), kSignalStateCount);
  }
}

// A place that is lost is missing until the program ends; one given back twice is played twice.
TEST(SignalTable, GivesEachPlaceBackOnceWhenItIsHeldNoLonger) {
  for (const SignalEdge& edge : kSignalEdges) {
    const bool held = Row(edge.from).holds_place;
    const bool holds = Row(edge.to).holds_place;
    const bool taken = edge.event == SignalEvent::kCommandExcite;
    const SignalAction expected = taken ? (held ? SignalAction::kReplace : SignalAction::kTake)
                                  : held && !holds ? SignalAction::kGiveBack
                                                   : edge.action;
    EXPECT_EQ(edge.action, expected) << Name(edge.from) << " " << Name(edge.event);
    EXPECT_EQ(holds, taken || (held && edge.action != SignalAction::kGiveBack));
  }
}

TEST(SignalTable, LeavesThePlayingStateOnlyWithACommandInTheRecord) {
  for (const SignalEdge& edge : kSignalEdges) {
    if (edge.from != SignalState::kPlaying || edge.to == SignalState::kPlaying) continue;
    const bool commanded =
        edge.event == SignalEvent::kCommandExcite || edge.event == SignalEvent::kCommandEnd;
    EXPECT_TRUE(commanded || edge.to == SignalState::kEndedUntold) << Name(edge.event);
  }
  EXPECT_EQ(Advance(SignalState::kEndedUntold, SignalEvent::kFreeCycle).action,
            SignalAction::kTellEnd);
}

TEST(DeskTables, HaveTheirOwnNamesForEverything) {
  ExpectDistinctNames<EndState>(kEndStateCount);
  ExpectDistinctNames<EndEvent>(kEndEventCount);
  ExpectDistinctNames<EndGuard>(kEndGuardCount);
  ExpectDistinctNames<EndAction>(kEndActionCount);
  ExpectDistinctNames<EndWatch>(kEndWatchCount);
  ExpectDistinctNames<SignalState>(kSignalStateCount);
  ExpectDistinctNames<SignalEvent>(kSignalEventCount);
  ExpectDistinctNames<SignalAction>(kSignalActionCount);
}

TEST(DeskChapter, IsWhatTheTablesSay) {
  const std::string path = levitas::test::SourceFolder() + "/docs/safety.md";
  std::ifstream file(path);
  std::ostringstream whole;
  whole << file.rdbuf();
  const std::string text = whole.str();
  const std::size_t chapter = text.find("## Commands and the end of a run\n");
  const std::size_t next = text.find("## Modes\n");
  ASSERT_LT(chapter, next) << path << " has no chapter \"Commands and the end of a run\"";
  ASSERT_NE(next, std::string::npos) << path << " has no chapter \"Modes\" after it";
  if (std::getenv("LEVITAS_WRITE_DOCS") != nullptr) {
    std::ofstream(path) << text.substr(0, chapter) << ArbiterDocument() << text.substr(next);
  } else {
    EXPECT_EQ(text.substr(chapter, next - chapter), ArbiterDocument())
        << "LEVITAS_WRITE_DOCS=1 makes this test write the chapter of " << path << " anew";
  }
}

}  // namespace
}  // namespace levitas::loop
