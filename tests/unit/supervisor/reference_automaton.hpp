#pragma once
// The modes as docs/safety.md describes them, written again from its tables by hand and without the
// supervisor's own: what two independent readings agree on is not one slip of the pen.
//
// Told       the fault that was found in a cycle, the command, and what can be seen; it judges
//            which state follows, whether the command is refused, and which cause is kept.
// Not told   when a lift or a self-test ends by itself: these times depend on ramps and radii, so
//            such a step is allowed whenever the document has it, and required never.

#include <cmath>
#include <set>

#include "controller/supervisor/supervisor.hpp"

namespace levitas::supervisor {

class ReferenceAutomaton {
 public:
  struct Cycle {
    Fault found{};
    OperatorCommand command{};
    bool standing{};     ///< proven
    bool turning{};      ///< as last believed
    bool speed_valid{};  ///< set point and acceleration of a spin command can be
    bool cause_gone{};   ///< fresh, plausible, no fault bit, standing
    bool wants_stand{};  ///< the latest accepted set point is zero
    std::uint64_t cycle{};
  };
  struct Answer {
    std::set<State> allowed;  ///< states that may follow
    bool refused{};
    Fault cause{};  ///< latched after this cycle
    std::uint64_t cause_cycle{};
  };

  explicit ReferenceAutomaton(State state = State::kOff) : state_(state) {}

  Answer Step(const Cycle& seen) {
    Answer answer;
    // A mark asks for nothing that could be refused.
    const bool ordinary = seen.command != OperatorCommand::kNone &&
                          seen.command != OperatorCommand::kEmergencyStop &&
                          seen.command != OperatorCommand::kMark;
    if (seen.found != Fault::kNone) {
      if (!Tripped()) {
        cause_ = seen.found;
        cause_cycle_ = seen.cycle;
      }
      answer.allowed = {AfterFault(seen.found)};
      answer.refused = ordinary;
    } else {
      State next = state_;
      const bool taken = ordinary && AfterCommand(seen, next);
      if (next == State::kOff && state_ == State::kTrippedReleased) {
        cause_ = Fault::kNone;
        cause_cycle_ = 0;
      }
      answer.refused = ordinary && !taken;
      answer.allowed = {next};
      if (!taken) AddWhatHappensByItself(seen, answer.allowed);
    }
    answer.cause = cause_;
    answer.cause_cycle = cause_cycle_;
    return answer;
  }

  /// The state the supervisor went to, once it was found allowed.
  void Follow(State state) { state_ = state; }

 private:
  [[nodiscard]] bool Tripped() const {
    return state_ == State::kTrippedStopping || state_ == State::kTrippedLanding ||
           state_ == State::kTrippedReleased;
  }

  [[nodiscard]] State AfterFault(Fault fault) const {
    static const std::set<Fault> kStops{
        Fault::kOrbitExceeded, Fault::kDeadlineMissed, Fault::kCoilSaturated, Fault::kOverSpeed,
        Fault::kEmergencyStop, Fault::kSpeedUnknown,   Fault::kFramesLost,    Fault::kCurrentsLate};
    const bool held = state_ == State::kLevitating || state_ == State::kSpinning ||
                      state_ == State::kCoastDown || state_ == State::kLanding;
    return held && kStops.contains(fault) ? State::kTrippedStopping : State::kTrippedReleased;
  }

  bool AfterCommand(const Cycle& seen, State& next) const {
    const bool turns = state_ == State::kSpinning || state_ == State::kCoastDown;
    const bool centred = turns || state_ == State::kLevitating;
    switch (seen.command) {
      case OperatorCommand::kLift:
        if (state_ != State::kOff || seen.turning) return false;
        next = State::kSelfTest;
        return true;
      case OperatorCommand::kSpin:
        if (!centred || !seen.speed_valid) return false;
        next = State::kSpinning;
        return true;
      case OperatorCommand::kCoastDown:
        if (!turns) return false;
        next = State::kCoastDown;
        return true;
      case OperatorCommand::kLand:
        if (state_ == State::kSelfTest) {
          next = State::kOff;
          return true;
        }
        if (state_ != State::kLift && !(centred && seen.standing)) return false;
        next = State::kLanding;
        return true;
      case OperatorCommand::kReset:
        if (state_ != State::kTrippedReleased || !seen.cause_gone) return false;
        next = State::kOff;
        return true;
      default:
        return false;
    }
  }

  void AddWhatHappensByItself(const Cycle& seen, std::set<State>& allowed) const {
    switch (state_) {
      case State::kSelfTest:
        if (seen.standing) allowed.insert(State::kLift);
        break;
      case State::kLift:
        allowed.insert(State::kLevitating);
        break;
      case State::kLanding:
        allowed.insert(State::kOff);
        break;
      case State::kTrippedLanding:
        allowed.insert(State::kTrippedReleased);
        if (!seen.standing) allowed.insert(State::kTrippedStopping);
        break;
      case State::kSpinning:
        if (seen.standing && seen.wants_stand) allowed = {State::kLevitating};
        break;
      case State::kCoastDown:
        if (seen.standing) allowed = {State::kLevitating};
        break;
      case State::kTrippedStopping:
        if (seen.standing) allowed = {State::kTrippedLanding};
        break;
      default:
        break;
    }
  }

  State state_;
  Fault cause_{Fault::kNone};
  std::uint64_t cause_cycle_{};
};

}  // namespace levitas::supervisor
