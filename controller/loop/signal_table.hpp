#pragma once
// A test signal of the network, as a table: every state and every edge. The chapter "Commands and
// the end of a run" of docs/safety.md is written from it.
//
// Begins     in the cycle after its command, unless that was refused.
// Ends       by its own length, by command, by a new one, with the run and where the mode passes no
//            test signal on. Each end is a command of the record: one that nobody commanded becomes
//            the command of the next cycle that has no other.
// Edges      a pair (state, event) that is not in the table has no effect.
// Thread     any; constant data and a pure function. No allocation, lock or exception.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/state_table.hpp"

namespace levitas::loop {

enum class SignalState : std::uint8_t {
  kNone,
  kAsked,        ///< its command was given, the controller has not answered
  kPlaying,      ///< added to the currents and positions of each cycle
  kEndedUntold,  ///< it has ended and no record says so yet
};
inline constexpr std::size_t kSignalStateCount = 4;

enum class SignalEvent : std::uint8_t {
  kCommandExcite,  ///< with a signal
  kCommandEnd,     ///< also a command to excite without a signal
  kRefused,        ///< the mode table does not allow the command to excite
  kAgreed,
  kCutOff,     ///< the run ends, or the mode passes no test signal on
  kOver,       ///< its length has passed
  kFreeCycle,  ///< nobody else gives a command in this cycle
};
inline constexpr std::size_t kSignalEventCount = 7;

/// A signal has a place in the pool, which whoever asked for it wants back.
enum class SignalAction : std::uint8_t {
  kNone,
  kTake,      ///< the new signal's place is held
  kReplace,   ///< the place is given back, the new signal's is held
  kGiveBack,  ///< the place is given back
  kTellEnd,   ///< end_excitation becomes the command of the cycle
};
inline constexpr std::size_t kSignalActionCount = 5;

struct SignalRow {
  SignalState state{};
  bool holds_place{};
  bool adds{};  ///< to the currents and positions of the cycle
};

struct SignalEdge {
  SignalState from{};
  SignalEvent event{};
  SignalState to{};
  SignalAction action{};
};

inline constexpr std::array<SignalRow, kSignalStateCount> kSignalStates{{
    {SignalState::kNone, false, false},
    {SignalState::kAsked, true, false},
    {SignalState::kPlaying, true, true},
    {SignalState::kEndedUntold, false, false},
}};

inline constexpr std::array kSignalEdges{
    SignalEdge{SignalState::kNone, SignalEvent::kCommandExcite, SignalState::kAsked,
               SignalAction::kTake},

    SignalEdge{SignalState::kAsked, SignalEvent::kCommandExcite, SignalState::kAsked,
               SignalAction::kReplace},
    SignalEdge{SignalState::kAsked, SignalEvent::kCommandEnd, SignalState::kNone,
               SignalAction::kGiveBack},
    SignalEdge{SignalState::kAsked, SignalEvent::kRefused, SignalState::kNone,
               SignalAction::kGiveBack},
    SignalEdge{SignalState::kAsked, SignalEvent::kAgreed, SignalState::kPlaying,
               SignalAction::kNone},

    SignalEdge{SignalState::kPlaying, SignalEvent::kCommandExcite, SignalState::kAsked,
               SignalAction::kReplace},
    SignalEdge{SignalState::kPlaying, SignalEvent::kCommandEnd, SignalState::kNone,
               SignalAction::kGiveBack},
    SignalEdge{SignalState::kPlaying, SignalEvent::kCutOff, SignalState::kEndedUntold,
               SignalAction::kGiveBack},
    SignalEdge{SignalState::kPlaying, SignalEvent::kOver, SignalState::kEndedUntold,
               SignalAction::kGiveBack},

    SignalEdge{SignalState::kEndedUntold, SignalEvent::kCommandExcite, SignalState::kAsked,
               SignalAction::kTake},
    SignalEdge{SignalState::kEndedUntold, SignalEvent::kCommandEnd, SignalState::kNone,
               SignalAction::kNone},
    SignalEdge{SignalState::kEndedUntold, SignalEvent::kFreeCycle, SignalState::kNone,
               SignalAction::kTellEnd},
};

[[nodiscard]] constexpr const SignalRow& Row(SignalState state) noexcept {
  return kSignalStates[static_cast<std::size_t>(state)];
}

/// The edge of (state, event), or nullptr. The table holds each pair at most once.
[[nodiscard]] constexpr const SignalEdge* FindEdge(SignalState state, SignalEvent event) noexcept {
  return FindEdgeIn(kSignalEdges, state, event);
}

struct SignalStep {
  SignalState to{};
  SignalAction action{};
};
/// What an event leads to.
[[nodiscard]] constexpr SignalStep Advance(SignalState from, SignalEvent event) noexcept {
  const SignalEdge* const edge = FindEdge(from, event);
  return edge == nullptr ? SignalStep{from, SignalAction::kNone}
                         : SignalStep{edge->to, edge->action};
}

// lower_snake_case names; "invalid" beyond the end.
[[nodiscard]] std::string_view Name(SignalState state) noexcept;
[[nodiscard]] std::string_view Name(SignalEvent event) noexcept;
[[nodiscard]] std::string_view Name(SignalAction action) noexcept;

}  // namespace levitas::loop
