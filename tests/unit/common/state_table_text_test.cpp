#include "common/state_table_text.hpp"

#include <gtest/gtest.h>

namespace levitas {
namespace machine {

enum class State { kShut, kOpen, kBroken };
enum class Event { kPush, kKick };
enum class Guard { kAlways, kUnlocked };
enum class Action { kNone, kRing };
struct Edge {
  State from{};
  Event event{};
  Guard guard{};
  State to{};
  Action action{};
};
struct Unguarded {
  State from{};
  Event event{};
  State to{};
  Action action{};
};

constexpr std::array<std::string_view, 3> kStates{"shut", "open", "broken"};
constexpr std::array<std::string_view, 2> kEvents{"push", "kick"};
constexpr std::array<std::string_view, 2> kGuards{"always", "unlocked"};
constexpr std::array<std::string_view, 2> kActions{"none", "ring"};
std::string_view Name(State state) { return NameIn(kStates, state); }
std::string_view Name(Event event) { return NameIn(kEvents, event); }
std::string_view Name(Guard guard) { return NameIn(kGuards, guard); }
std::string_view Name(Action action) { return NameIn(kActions, action); }

constexpr std::array kDoor{
    Edge{State::kShut, Event::kPush, Guard::kUnlocked, State::kOpen, Action::kRing},
    Edge{State::kOpen, Event::kPush, Guard::kAlways, State::kShut, Action::kNone}};

TEST(NameIn, IsInvalidBeyondTheEnd) {
  EXPECT_EQ(Name(State::kBroken), "broken");
  EXPECT_EQ(Name(static_cast<State>(3)), "invalid");
}

TEST(StateDiagram, ShowsEventsAndOfGuardsThoseThatMayFail) {
  EXPECT_EQ(StateDiagram(State::kShut, kDoor),
            "```mermaid\nstateDiagram-v2\n  [*] --> shut\n  shut --> open : push [unlocked]\n"
            "  open --> shut : push\n```\n");
}

TEST(StateDiagram, EndsWhereNoEdgeLeaves) {
  constexpr std::array kKicked{
      kDoor[0], kDoor[1],
      Edge{State::kShut, Event::kKick, Guard::kAlways, State::kBroken, Action::kNone},
      Edge{State::kOpen, Event::kKick, Guard::kAlways, State::kBroken, Action::kNone}};
  const std::string diagram = StateDiagram(State::kShut, kKicked);
  const std::size_t end = diagram.find("  broken --> [*]\n");
  ASSERT_NE(end, std::string::npos) << diagram;
  EXPECT_EQ(diagram.find("--> [*]", end + 15), std::string::npos) << diagram;  // once
}

TEST(EdgeRows, HaveAColumnForGuardsOnlyWhereEdgesHaveThem) {
  EXPECT_EQ(EdgeRows(kDoor),
            "| from | event | only if | to | action |\n|---|---|---|---|---|\n"
            "| shut | push | unlocked | open | ring |\n| open | push | always | shut | none |\n");
  constexpr std::array kPlain{Unguarded{State::kShut, Event::kPush, State::kOpen, Action::kRing}};
  EXPECT_EQ(EdgeRows(kPlain),
            "| from | event | to | action |\n|---|---|---|---|\n| shut | push | open | ring |\n");
}

}  // namespace machine
}  // namespace levitas
