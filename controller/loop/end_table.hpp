#pragma once
// How a run ends, as a table: every state, what the arbiter does in it, every edge between states.
// The chapter "Commands and the end of a run" of docs/safety.md is written from it.
//
// Cycle      each asks up to three questions, in this order, and each answer is one event: whether
//            the run is to end, whether the magnets hold the rotor, what the rotor does. The first
//            that holds counts, in the order in which they stand below.
// Edges      a pair (state, event) that is not in the table has no effect; an edge whose guard does
//            not hold counts as absent.
// Done       has no edge: the loop makes no cycle after it.
// Thread     any; constant data and a pure function. No allocation, lock or exception.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/state_table.hpp"

namespace levitas::loop {

enum class EndState : std::uint8_t {
  kServing,             ///< nothing ends: remote commands and the scenario are given
  kEnding,              ///< to be landed; nothing had to be braked so far
  kBraking,             ///< as kEnding, and the drive was told to stop
  kAwaitingStandstill,  ///< the magnets have let go, the supervisor brakes what still turns
  kDone,
};
inline constexpr std::size_t kEndStateCount = 5;

enum class EndEvent : std::uint8_t {
  // Is the run to end?
  kScenarioOver,   ///< finished or failed
  kDurationOver,   ///< since the first cycle
  kStopRequested,  ///< by a signal, or by who started the program
  // Do the magnets hold the rotor?
  kReleased,  ///< off or tripped, without current
  kHeld,      ///< anything else
  // What does a rotor that is held do?
  kStops,    ///< a levitated stop: it brakes and lands by itself
  kOverdue,  ///< it does not come down (run_down.hpp)
  kLands,    ///< it is being lowered
  kStands,   ///< proven to stand; also of a rotor that was let go
  kSpins,    ///< under the drive, not proven to stand
  kTurns,    ///< in another mode, not proven to stand
  // What does one that was let go do? It stands, or:
  kBrakeFails,  ///< its speed does not fall (run_down.hpp)
};
inline constexpr std::size_t kEndEventCount = 12;

enum class EndGuard : std::uint8_t {
  kAlways,
  kRequestDue,  ///< the latest request was made some time ago, and has not been followed
  kRecorded,    ///< off, or the record of the trip has its length
};
inline constexpr std::size_t kEndGuardCount = 3;

enum class EndAction : std::uint8_t {
  kNone,
  kBegin,        ///< time of the run-down starts, a request is due at once
  kAskBrake,     ///< spin to 0 at the rate of the files
  kAskLanding,   ///< land
  kAskStop,      ///< emergency stop
  kTimeRelease,  ///< time of the release and of the brake starts
};
inline constexpr std::size_t kEndActionCount = 6;

/// What is looked for in a state and becomes news when it is found.
enum class EndWatch : std::uint8_t { kNothing, kLanding, kBrake };
inline constexpr std::size_t kEndWatchCount = 3;

struct EndRow {
  EndState state{};
  bool serves{};  ///< remote commands and the scenario are given; else the former are dropped
  EndWatch watch{};
};

struct EndEdge {
  EndState from{};
  EndEvent event{};
  EndGuard guard{};
  EndState to{};
  EndAction action{};
};

inline constexpr std::array<EndRow, kEndStateCount> kEndStates{{
    {EndState::kServing, true, EndWatch::kNothing},
    {EndState::kEnding, false, EndWatch::kLanding},
    {EndState::kBraking, false, EndWatch::kLanding},
    {EndState::kAwaitingStandstill, false, EndWatch::kBrake},
    {EndState::kDone, false, EndWatch::kNothing},
}};

inline constexpr std::array kEndEdges{
    EndEdge{EndState::kServing, EndEvent::kScenarioOver, EndGuard::kAlways, EndState::kEnding,
            EndAction::kBegin},
    EndEdge{EndState::kServing, EndEvent::kDurationOver, EndGuard::kAlways, EndState::kEnding,
            EndAction::kBegin},
    EndEdge{EndState::kServing, EndEvent::kStopRequested, EndGuard::kAlways, EndState::kEnding,
            EndAction::kBegin},

    EndEdge{EndState::kEnding, EndEvent::kReleased, EndGuard::kAlways,
            EndState::kAwaitingStandstill, EndAction::kTimeRelease},
    EndEdge{EndState::kEnding, EndEvent::kOverdue, EndGuard::kRequestDue, EndState::kEnding,
            EndAction::kAskStop},
    EndEdge{EndState::kEnding, EndEvent::kStands, EndGuard::kRequestDue, EndState::kEnding,
            EndAction::kAskLanding},
    EndEdge{EndState::kEnding, EndEvent::kSpins, EndGuard::kRequestDue, EndState::kBraking,
            EndAction::kAskBrake},
    EndEdge{EndState::kEnding, EndEvent::kTurns, EndGuard::kRequestDue, EndState::kBraking,
            EndAction::kAskBrake},

    EndEdge{EndState::kBraking, EndEvent::kReleased, EndGuard::kAlways,
            EndState::kAwaitingStandstill, EndAction::kTimeRelease},
    EndEdge{EndState::kBraking, EndEvent::kOverdue, EndGuard::kRequestDue, EndState::kBraking,
            EndAction::kAskStop},
    EndEdge{EndState::kBraking, EndEvent::kStands, EndGuard::kRequestDue, EndState::kBraking,
            EndAction::kAskLanding},
    EndEdge{EndState::kBraking, EndEvent::kTurns, EndGuard::kRequestDue, EndState::kBraking,
            EndAction::kAskBrake},

    EndEdge{EndState::kAwaitingStandstill, EndEvent::kHeld, EndGuard::kAlways, EndState::kEnding,
            EndAction::kNone},
    EndEdge{EndState::kAwaitingStandstill, EndEvent::kStands, EndGuard::kRecorded, EndState::kDone,
            EndAction::kNone},
    EndEdge{EndState::kAwaitingStandstill, EndEvent::kBrakeFails, EndGuard::kRecorded,
            EndState::kDone, EndAction::kNone},
};

[[nodiscard]] constexpr const EndRow& Row(EndState state) noexcept {
  return kEndStates[static_cast<std::size_t>(state)];
}

/// The edge of (state, event), or nullptr. The table holds each pair at most once.
[[nodiscard]] constexpr const EndEdge* FindEdge(EndState state, EndEvent event) noexcept {
  return FindEdgeIn(kEndEdges, state, event);
}

/// Which guards hold.
struct EndGuards {
  bool request_due{};
  bool recorded{};
  [[nodiscard]] constexpr bool Holds(EndGuard guard) const noexcept {
    switch (guard) {
      case EndGuard::kAlways:
        return true;
      case EndGuard::kRequestDue:
        return request_due;
      case EndGuard::kRecorded:
        return recorded;
    }
    return false;
  }
};

struct EndStep {
  EndState to{};
  EndAction action{};
};
/// What an event leads to.
[[nodiscard]] constexpr EndStep Advance(EndState from, EndEvent event,
                                        const EndGuards& guards) noexcept {
  const EndEdge* const edge = FindEdge(from, event);
  if (edge == nullptr || !guards.Holds(edge->guard)) return {from, EndAction::kNone};
  return {edge->to, edge->action};
}

// lower_snake_case names; "invalid" beyond the end.
[[nodiscard]] std::string_view Name(EndState state) noexcept;
[[nodiscard]] std::string_view Name(EndEvent event) noexcept;
[[nodiscard]] std::string_view Name(EndGuard guard) noexcept;
[[nodiscard]] std::string_view Name(EndAction action) noexcept;
[[nodiscard]] std::string_view Name(EndWatch watch) noexcept;

}  // namespace levitas::loop
