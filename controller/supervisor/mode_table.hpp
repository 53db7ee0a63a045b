#pragma once
// The mode table: every state, what the rig does in it, and every edge between states, as data.
// The last chapter of docs/safety.md is written from it; the others say why it is as it is.
//
// States     finer than Mode: a trip passes through up to three of them, all Mode::kTripped.
// Edges      a pair (state, event) that is not in the table: a command is refused, anything else
//            has no effect. An edge whose guard does not hold counts as absent.
// Faults     come as one of two events: kStopFault while the position signals can be trusted,
//            kDropFault when they cannot or the magnets do not hold the rotor any more.
// Thread     any; constant data.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/enums.hpp"
#include "common/state_table.hpp"

namespace levitas::supervisor {

enum class State : std::uint8_t {
  kOff,
  kSelfTest,
  kLift,
  kLevitating,
  kSpinning,
  kCoastDown,
  kLanding,
  kTrippedStopping,  ///< safe state A: levitated, drive brakes
  kTrippedLanding,   ///< safe state A, rotor stands: being lowered
  kTrippedReleased,  ///< safe state B, and the end of A: coils without current
};
inline constexpr std::size_t kStateCount = 10;

enum class Event : std::uint8_t {
  kCommandLift,
  kCommandSpin,
  kCommandCoastDown,
  kCommandLand,
  kCommandReset,
  kSelfTestPassed,
  kLifted,  ///< the rotor stayed near the centre long enough
  kStands,  ///< proven to stand, and nobody wants it to turn
  kLanded,  ///< landing ramp finished
  kTurns,   ///< believed to turn for some time, or the speed is unknown
  kStopFault,
  kDropFault,
};
inline constexpr std::size_t kEventCount = 12;

enum class Guard : std::uint8_t {
  kAlways,
  kStanding,    ///< proven to stand
  kNotTurning,  ///< nothing says that the rotor turns
  kSpeedValid,  ///< set point finite and within the rated speed, acceleration positive
  kCauseGone,   ///< fresh plausible frame, no fault bit from the rig, rotor stands
};

/// What an edge does beside the change of state (the time in the state always starts anew).
enum class Action : std::uint8_t {
  kNone,
  kStartLaw,   ///< law memory cleared, reference starts where the rotor rests
  kTakeSpeed,  ///< set point and acceleration of the command become the drive's
  kLatch,      ///< cause of the trip kept until reset
  kClearLatch,
};

struct Edge {
  State from{};
  Event event{};
  Guard guard{};
  State to{};
  Action action{};
};

/// How the reference of the law moves in a state. To the centre from wherever it is.
enum class Reference : std::uint8_t { kNone, kRampToCentre, kCentre, kRampToRest };
/// What the drive is told: no torque; the operator's set point; set point 0 at the trip's rate, as
/// long as the rotor may turn.
enum class Drive : std::uint8_t { kFree, kSetPoint, kBrake };

using FaultSet = std::uint32_t;
[[nodiscard]] constexpr FaultSet Bit(Fault fault) noexcept {
  return FaultSet{1} << static_cast<unsigned>(fault);
}

/// What the rig does in a state.
struct StateRow {
  State state{};
  Mode mode{};
  bool energised{};  ///< bias on, law runs; else both coils of every axis carry no current
  Reference reference{};
  Drive drive{};
  bool excitation{};  ///< injected currents are let through
  FaultSet armed{};   ///< faults that are looked for
  FaultSet drop{};    ///< those that come as kDropFault; the others come as kStopFault
};

/// Faults after which the position signals or the magnets cannot be trusted.
inline constexpr FaultSet kDropFaults =
    Bit(Fault::kSensorOutOfRange) | Bit(Fault::kSensorFrozen) | Bit(Fault::kSensorNotFinite) |
    Bit(Fault::kFrameMissing) | Bit(Fault::kRigRestarted) | Bit(Fault::kAmplifierFault) |
    Bit(Fault::kSelfTestFailed) | Bit(Fault::kLiftFailed) | Bit(Fault::kLawNotFinite);

inline constexpr FaultSet kSignalFaults =
    Bit(Fault::kSensorOutOfRange) | Bit(Fault::kSensorFrozen) | Bit(Fault::kSensorNotFinite) |
    Bit(Fault::kFrameMissing) | Bit(Fault::kRigRestarted) | Bit(Fault::kAmplifierFault);
inline constexpr FaultSet kLevitatedFaults =
    kSignalFaults | Bit(Fault::kDeadlineMissed) | Bit(Fault::kCoilSaturated) |
    Bit(Fault::kOverSpeed) | Bit(Fault::kEmergencyStop) | Bit(Fault::kSpeedUnknown) |
    Bit(Fault::kLawNotFinite) | Bit(Fault::kFramesLost) | Bit(Fault::kCurrentsLate);

inline constexpr std::array<StateRow, kStateCount> kStates{{
    {State::kOff, Mode::kOff, false, Reference::kNone, Drive::kBrake, false,
     Bit(Fault::kEmergencyStop), kDropFaults},
    {State::kSelfTest, Mode::kSelfTest, false, Reference::kNone, Drive::kFree, false,
     kSignalFaults | Bit(Fault::kEmergencyStop) | Bit(Fault::kSpeedUnknown) |
         Bit(Fault::kSelfTestFailed),
     kDropFaults},
    {State::kLift, Mode::kLift, true, Reference::kRampToCentre, Drive::kFree, false,
     kLevitatedFaults | Bit(Fault::kLiftFailed), kDropFaults},
    {State::kLevitating, Mode::kLevitating, true, Reference::kCentre, Drive::kFree, true,
     kLevitatedFaults | Bit(Fault::kOrbitExceeded), kDropFaults},
    {State::kSpinning, Mode::kSpinning, true, Reference::kCentre, Drive::kSetPoint, true,
     kLevitatedFaults | Bit(Fault::kOrbitExceeded), kDropFaults},
    {State::kCoastDown, Mode::kCoastDown, true, Reference::kCentre, Drive::kFree, true,
     kLevitatedFaults | Bit(Fault::kOrbitExceeded), kDropFaults},
    {State::kLanding, Mode::kLanding, true, Reference::kRampToRest, Drive::kFree, false,
     kLevitatedFaults | Bit(Fault::kOrbitExceeded), kDropFaults},
    {State::kTrippedStopping, Mode::kTripped, true, Reference::kCentre, Drive::kBrake, false,
     kSignalFaults | Bit(Fault::kOrbitExceeded) | Bit(Fault::kLawNotFinite),
     kDropFaults | Bit(Fault::kOrbitExceeded)},
    {State::kTrippedLanding, Mode::kTripped, true, Reference::kRampToRest, Drive::kBrake, false,
     kSignalFaults | Bit(Fault::kOrbitExceeded) | Bit(Fault::kLawNotFinite),
     kDropFaults | Bit(Fault::kOrbitExceeded)},
    {State::kTrippedReleased, Mode::kTripped, false, Reference::kNone, Drive::kBrake, false, 0, 0},
}};

inline constexpr std::array kEdges{
    Edge{State::kOff, Event::kCommandLift, Guard::kNotTurning, State::kSelfTest, Action::kNone},
    Edge{State::kOff, Event::kStopFault, Guard::kAlways, State::kTrippedReleased, Action::kLatch},

    Edge{State::kSelfTest, Event::kSelfTestPassed, Guard::kAlways, State::kLift, Action::kStartLaw},
    Edge{State::kSelfTest, Event::kCommandLand, Guard::kAlways, State::kOff, Action::kNone},
    Edge{State::kSelfTest, Event::kStopFault, Guard::kAlways, State::kTrippedReleased,
         Action::kLatch},
    Edge{State::kSelfTest, Event::kDropFault, Guard::kAlways, State::kTrippedReleased,
         Action::kLatch},

    Edge{State::kLift, Event::kLifted, Guard::kAlways, State::kLevitating, Action::kNone},
    Edge{State::kLift, Event::kCommandLand, Guard::kAlways, State::kLanding, Action::kNone},
    Edge{State::kLift, Event::kStopFault, Guard::kAlways, State::kTrippedReleased, Action::kLatch},
    Edge{State::kLift, Event::kDropFault, Guard::kAlways, State::kTrippedReleased, Action::kLatch},

    Edge{State::kLevitating, Event::kCommandSpin, Guard::kSpeedValid, State::kSpinning,
         Action::kTakeSpeed},
    Edge{State::kLevitating, Event::kCommandLand, Guard::kStanding, State::kLanding, Action::kNone},
    Edge{State::kLevitating, Event::kStopFault, Guard::kAlways, State::kTrippedStopping,
         Action::kLatch},
    Edge{State::kLevitating, Event::kDropFault, Guard::kAlways, State::kTrippedReleased,
         Action::kLatch},

    Edge{State::kSpinning, Event::kCommandSpin, Guard::kSpeedValid, State::kSpinning,
         Action::kTakeSpeed},
    Edge{State::kSpinning, Event::kCommandCoastDown, Guard::kAlways, State::kCoastDown,
         Action::kNone},
    Edge{State::kSpinning, Event::kCommandLand, Guard::kStanding, State::kLanding, Action::kNone},
    Edge{State::kSpinning, Event::kStands, Guard::kAlways, State::kLevitating, Action::kNone},
    Edge{State::kSpinning, Event::kStopFault, Guard::kAlways, State::kTrippedStopping,
         Action::kLatch},
    Edge{State::kSpinning, Event::kDropFault, Guard::kAlways, State::kTrippedReleased,
         Action::kLatch},

    Edge{State::kCoastDown, Event::kCommandSpin, Guard::kSpeedValid, State::kSpinning,
         Action::kTakeSpeed},
    Edge{State::kCoastDown, Event::kCommandCoastDown, Guard::kAlways, State::kCoastDown,
         Action::kNone},
    Edge{State::kCoastDown, Event::kCommandLand, Guard::kStanding, State::kLanding, Action::kNone},
    Edge{State::kCoastDown, Event::kStands, Guard::kAlways, State::kLevitating, Action::kNone},
    Edge{State::kCoastDown, Event::kStopFault, Guard::kAlways, State::kTrippedStopping,
         Action::kLatch},
    Edge{State::kCoastDown, Event::kDropFault, Guard::kAlways, State::kTrippedReleased,
         Action::kLatch},

    Edge{State::kLanding, Event::kLanded, Guard::kAlways, State::kOff, Action::kNone},
    Edge{State::kLanding, Event::kStopFault, Guard::kAlways, State::kTrippedStopping,
         Action::kLatch},
    Edge{State::kLanding, Event::kDropFault, Guard::kAlways, State::kTrippedReleased,
         Action::kLatch},

    Edge{State::kTrippedStopping, Event::kStands, Guard::kAlways, State::kTrippedLanding,
         Action::kNone},
    Edge{State::kTrippedStopping, Event::kDropFault, Guard::kAlways, State::kTrippedReleased,
         Action::kNone},
    Edge{State::kTrippedLanding, Event::kTurns, Guard::kAlways, State::kTrippedStopping,
         Action::kNone},
    Edge{State::kTrippedLanding, Event::kLanded, Guard::kAlways, State::kTrippedReleased,
         Action::kNone},
    Edge{State::kTrippedLanding, Event::kDropFault, Guard::kAlways, State::kTrippedReleased,
         Action::kNone},
    Edge{State::kTrippedReleased, Event::kCommandReset, Guard::kCauseGone, State::kOff,
         Action::kClearLatch},
};

[[nodiscard]] constexpr const StateRow& Row(State state) noexcept {
  return kStates[static_cast<std::size_t>(state)];
}

/// Whether injected currents are let through in a mode.
[[nodiscard]] constexpr bool PassesExcitation(Mode mode) noexcept {
  for (const StateRow& row : kStates) {
    if (row.mode == mode && row.excitation) return true;
  }
  return false;
}

/// The edge of (state, event), or nullptr. The table holds each pair at most once.
[[nodiscard]] constexpr const Edge* FindEdge(State state, Event event) noexcept {
  return FindEdgeIn(kEdges, state, event);
}

// lower_snake_case names; "invalid" beyond the end.
[[nodiscard]] std::string_view Name(State state) noexcept;
[[nodiscard]] std::string_view Name(Event event) noexcept;
[[nodiscard]] std::string_view Name(Guard guard) noexcept;
[[nodiscard]] std::string_view Name(Action action) noexcept;
[[nodiscard]] std::string_view Name(Reference reference) noexcept;
[[nodiscard]] std::string_view Name(Drive drive) noexcept;

/// The chapter "Modes" of docs/safety.md, its last, as it must read for this table.
[[nodiscard]] std::string ModeTableDocument();

}  // namespace levitas::supervisor
