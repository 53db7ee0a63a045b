#include "controller/supervisor/supervisor.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>

namespace levitas::supervisor {
namespace {

/// The same acceleration in rpm/s, read from two files, may differ by its last bits.
constexpr double kRounding = 1.0 + 1e-9;

std::uint64_t Cycles(double time_s, double period_s, const char* name) {
  const double cycles = time_s / period_s;
  if (!(cycles >= 0.0 && cycles < 1e15)) {
    throw std::invalid_argument(std::string("supervisor: ") + name + " = " +
                                std::to_string(time_s) + " s, must be 0 or more");
  }
  return static_cast<std::uint64_t>(std::llround(cycles));
}

std::optional<Event> CommandEvent(OperatorCommand command) noexcept {
  switch (command) {
    case OperatorCommand::kLift:
      return Event::kCommandLift;
    case OperatorCommand::kSpin:
      return Event::kCommandSpin;
    case OperatorCommand::kCoastDown:
      return Event::kCommandCoastDown;
    case OperatorCommand::kLand:
      return Event::kCommandLand;
    case OperatorCommand::kReset:
      return Event::kCommandReset;
    case OperatorCommand::kNone:
    case OperatorCommand::kEmergencyStop:  // a fault, see Protections
    case OperatorCommand::kExcite:         // no edge: the state stays, see Refuses
    case OperatorCommand::kEndExcitation:
    case OperatorCommand::kMark:
      break;
  }
  return std::nullopt;
}

// Of commands that move no edge: a number outside the enumeration is one the table does not know,
// and a test signal may begin only where the table passes it on.
bool Refuses(State state, OperatorCommand command) noexcept {
  if (command == OperatorCommand::kExcite) return !Row(state).excitation;
  return static_cast<std::uint8_t>(command) >= kOperatorCommandCount;
}

}  // namespace

Supervisor::Supervisor(const RigNumbers& rig, const SupervisorConfig& config)
    : axes_(rig.axes()),
      max_speed_rad_per_s_(rig.max_speed_rad_per_s),
      max_acceleration_rad_per_s2_(rig.max_acceleration_rad_per_s2),
      sequence_(config.sequence),
      implausible_limit_cycles_(config.protection.sensor_range_cycles),
      protections_(rig, config.protection),
      speed_(rig, config.sequence) {
  const SequenceConfig& s = config.sequence;
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    resting_limit_m_[b] = kRestingPlaceFactor * rig.ClearanceOf(b);
    settle_limit_m_[b] = s.settle_radius_m;
  }
  const double period_s = rig.period_s();
  times_ = {Cycles(s.self_test_s, period_s, "self_test_s"),
            Cycles(s.lift_ramp_s, period_s, "lift_ramp_s"),
            Cycles(s.lift_settle_s, period_s, "lift_settle_s"),
            Cycles(s.lift_timeout_s, period_s, "lift_timeout_s"),
            Cycles(s.landing_ramp_s, period_s, "landing_ramp_s")};
  if (!(s.settle_radius_m > 0.0) || !(s.standstill_rad_per_s > 0.0) ||
      !(s.trip_acceleration_rad_per_s2 > 0.0)) {
    throw std::invalid_argument(
        "supervisor: settle_radius_m, standstill_rad_per_s and trip_acceleration_rad_per_s2 must "
        "be greater than 0");
  }
}

Finding Supervisor::Check(const Observation& seen, const Request& request) noexcept {
  const StateRow& row = Row(decision_.state);
  // Without current nothing depends on the rig's past, so its present session is the known one. The
  // same holds for the first frame of all, which may come after the command to lift.
  const bool idle = !row.energised && decision_.state != State::kSelfTest;
  if (seen.fresh && (idle || !protections_.session_known())) {
    if (!protections_.Knows(seen.rig_session)) speed_.Forget();
    protections_.AcceptSession(seen.rig_session);
  }
  const bool braked = decision_.drive_enabled && decision_.speed_set_point_rad_per_s == 0.0;
  speed_.Update(seen, braked ? decision_.acceleration_rad_per_s2 : 0.0);
  // During a levitated stop the orbit that tripped may go on; only lasting contact counts then.
  const bool stopping = decision_.state == State::kTrippedStopping;
  const Finding finding = protections_.Check(
      seen, {.armed = stopping ? row.armed & ~Bit(Fault::kOrbitExceeded) : row.armed,
             .energised = row.energised,
             .stop_requested = request.command == OperatorCommand::kEmergencyStop,
             .reference_m = Expected(seen),
             .speed = SpeedFinding()});
  if (finding.fault != Fault::kNone) return finding;
  if (decision_.state == State::kSelfTest) return SelfTest(seen);
  if (decision_.state == State::kLift) return Lift(seen);
  if (stopping && !Returning()) return protections_.Contact(seen);
  return finding;
}

// A rotor that is lowered may run ahead of its reference: near the wall the magnets pull it over to
// its resting place at once. It is expected on the line from the one to the other.
AxisArray Supervisor::Expected(const Observation& seen) const noexcept {
  AxisArray expected_m = decision_.reference_m;
  if (Row(decision_.state).reference != Reference::kRampToRest) return expected_m;
  for (std::size_t x = 0; x + 1 < axes_; x += 2) {
    const double to_x_m = rest_m_[x] - expected_m[x];
    const double to_y_m = rest_m_[x + 1] - expected_m[x + 1];
    const double length2 = to_x_m * to_x_m + to_y_m * to_y_m;
    const double along = (seen.position_m[x] - expected_m[x]) * to_x_m +
                         (seen.position_m[x + 1] - expected_m[x + 1]) * to_y_m;
    if (!(along > 0.0)) continue;  // also a position that is no number
    const double share = std::min(along / length2, 1.0);
    expected_m[x] += share * to_x_m;
    expected_m[x + 1] += share * to_y_m;
  }
  return expected_m;
}

// Whoever lands was proven to stand: if the rotor turns all the same, the speed was not known.
Finding Supervisor::SpeedFinding() const noexcept {
  if (speed_.unknown()) return speed_.Contradiction();
  if (decision_.state == State::kLanding && speed_.turns()) {
    return {Fault::kSpeedUnknown, -1, speed_.Magnitude(), sequence_.standstill_rad_per_s};
  }
  return {};
}

// On the way back from a landing: the rotor may still touch where it was being lowered to.
bool Supervisor::Returning() const noexcept {
  return cycles_in_state_ < times_.lift_ramp && ramp_from_m_ != AxisArray{};
}

const Decision& Supervisor::Decide(const Observation& seen, const Request& request,
                                   const Finding& finding) noexcept {
  decision_.start_law = false;
  decision_.command_refused = false;
  decision_.standing = speed_.stands();
  decision_.turning = speed_.may_turn();
  decision_.believed_speed_rad_per_s = speed_.Estimate();
  ++cycles_in_state_;
  const std::optional<Event> command = CommandEvent(request.command);
  if (finding.fault != Fault::kNone) {
    const bool drop = (Row(decision_.state).drop & Bit(finding.fault)) != 0;
    Take(drop ? Event::kDropFault : Event::kStopFault, seen, request, finding);
    decision_.command_refused = command.has_value() || Refuses(decision_.state, request.command);
  } else {
    const bool moved = command && Take(*command, seen, request, finding);
    decision_.command_refused = (command && !moved) || Refuses(decision_.state, request.command);
    for (const Event event :
         {Event::kSelfTestPassed, Event::kLifted, Event::kStands, Event::kTurns, Event::kLanded}) {
      if (!moved && Happened(event, seen) && Take(event, seen, request, finding)) break;
    }
  }
  MoveReference();
  CommandDrive(seen);
  return decision_;
}

const Decision& Supervisor::Drop(const Observation& seen, const Finding& finding) noexcept {
  const StateRow& row = Row(decision_.state);
  if ((row.armed & row.drop & Bit(finding.fault)) == 0) return decision_;
  Take(Event::kDropFault, seen, {}, finding);
  MoveReference();
  CommandDrive(seen);
  return decision_;
}

// Plausible: the rotor lies within the touchdown bearings and does not turn. (Finite, in range,
// live and fault-free is what the protections armed in this state look for.)
Finding Supervisor::SelfTest(const Observation& seen) noexcept {
  if (!seen.fresh) return {};
  Finding found = FarthestBearing(seen, resting_limit_m_);
  bool implausible = !(found.value <= found.limit);
  if (!implausible && speed_.may_turn()) {
    found = {Fault::kNone, -1, speed_.Magnitude(), sequence_.standstill_rad_per_s};
    implausible = true;
  }
  implausible_cycles_ = implausible ? implausible_cycles_ + 1 : 0;
  if (implausible_cycles_ < implausible_limit_cycles_) return {};
  found.fault = Fault::kSelfTestFailed;
  return found;
}

Finding Supervisor::Lift(const Observation& seen) noexcept {
  Finding found = FarthestBearing(seen, settle_limit_m_);
  // A cycle without a frame says nothing about the rotor: it neither counts nor starts anew.
  // (Frames that stay away are a fault of their own.)
  if (seen.fresh) {
    const bool near_centre = cycles_in_state_ >= times_.lift_ramp && found.value <= found.limit;
    near_centre_cycles_ = near_centre ? near_centre_cycles_ + 1 : 0;
  }
  if (cycles_in_state_ < times_.lift_timeout || near_centre_cycles_ >= times_.lift_settle) {
    return {};
  }
  found.fault = Fault::kLiftFailed;
  return found;
}

bool Supervisor::Happened(Event event, const Observation& seen) const noexcept {
  switch (event) {
    case Event::kSelfTestPassed:
      return seen.fresh && implausible_cycles_ == 0 && cycles_in_state_ > times_.self_test &&
             speed_.stands();
    case Event::kLifted:
      return near_centre_cycles_ > 0 && near_centre_cycles_ >= times_.lift_settle;
    case Event::kStands:
      return speed_.stands() &&
             (Row(decision_.state).drive != Drive::kSetPoint || set_point_rad_per_s_ == 0.0);
    case Event::kTurns:
      return speed_.turns();
    case Event::kLanded:
      return cycles_in_state_ > times_.landing_ramp;
    default:
      return false;
  }
}

bool Supervisor::Holds(Guard guard, const Observation& seen,
                       const Request& request) const noexcept {
  switch (guard) {
    case Guard::kAlways:
      return true;
    case Guard::kStanding:
      return speed_.stands();
    case Guard::kNotTurning:
      return !speed_.may_turn();
    case Guard::kSpeedValid:  // written so that NaN does not pass
      return std::abs(request.speed_rad_per_s) <= max_speed_rad_per_s_ &&
             request.acceleration_rad_per_s2 > 0.0 &&
             std::isfinite(request.acceleration_rad_per_s2) &&
             request.acceleration_rad_per_s2 <= kRounding * max_acceleration_rad_per_s2_;
    case Guard::kCauseGone:
      return protections_.SignalsGood(seen) && speed_.stands();
  }
  return false;
}

bool Supervisor::Take(Event event, const Observation& seen, const Request& request,
                      const Finding& finding) noexcept {
  const Edge* const edge = FindEdge(decision_.state, event);
  if (edge == nullptr || !Holds(edge->guard, seen, request)) return false;
  if (Row(decision_.state).energised && !Row(edge->to).energised) decision_.released = finding;
  Enter(edge->to);
  Act(edge->action, seen, request, finding);
  return true;
}

void Supervisor::Act(Action action, const Observation& seen, const Request& request,
                     const Finding& finding) noexcept {
  switch (action) {
    case Action::kNone:
      break;
    case Action::kStartLaw:
      decision_.start_law = true;
      rest_m_ = seen.position_m;
      ramp_from_m_ = rest_m_;
      break;
    case Action::kTakeSpeed:
      set_point_rad_per_s_ = request.speed_rad_per_s;
      acceleration_rad_per_s2_ = request.acceleration_rad_per_s2;
      break;
    case Action::kLatch:
      decision_.latch = {finding, seen.cycle};
      break;
    case Action::kClearLatch:
      decision_.latch = {};
      break;
  }
}

void Supervisor::Enter(State state) noexcept {
  decision_.state = state;
  cycles_in_state_ = 0;
  implausible_cycles_ = 0;
  near_centre_cycles_ = 0;
  ramp_from_m_ = decision_.reference_m;
}

void Supervisor::MoveReference() noexcept {
  const Reference reference = Row(decision_.state).reference;
  if (reference == Reference::kNone) {
    decision_.reference_m = {};
    return;
  }
  const bool lifting = reference != Reference::kRampToRest;
  const std::uint64_t ramp_cycles = lifting ? times_.lift_ramp : times_.landing_ramp;
  const double p = cycles_in_state_ >= ramp_cycles
                       ? 1.0
                       : static_cast<double>(cycles_in_state_) / static_cast<double>(ramp_cycles);
  const double share = p * p * (3.0 - 2.0 * p);
  for (std::size_t i = 0; i < axes_; ++i) {
    const double to_m = lifting ? 0.0 : rest_m_[i];
    decision_.reference_m[i] = ramp_from_m_[i] + share * (to_m - ramp_from_m_[i]);
  }
}

void Supervisor::CommandDrive(const Observation& seen) noexcept {
  const Drive drive = Row(decision_.state).drive;
  decision_.drive_enabled = false;
  decision_.speed_set_point_rad_per_s = 0.0;
  decision_.acceleration_rad_per_s2 = 0.0;
  if (drive == Drive::kSetPoint) {
    decision_.drive_enabled = true;
    decision_.speed_set_point_rad_per_s = set_point_rad_per_s_;
    decision_.acceleration_rad_per_s2 = acceleration_rad_per_s2_;
  } else if (drive == Drive::kBrake) {
    // While the speed is not known the brake stays on: it does nothing to a rotor that stands. In
    // off the rig may be another's, so it is braked only where its rotor is seen to turn.
    const bool off = decision_.state == State::kOff;
    decision_.drive_enabled = off ? speed_.may_turn() : !(seen.fresh && speed_.stands());
    if (off && !decision_.drive_enabled) return;
    decision_.acceleration_rad_per_s2 = sequence_.trip_acceleration_rad_per_s2;
  }
}

// Of its own limit, not in metres: bearings may have different clearances.
Finding Supervisor::FarthestBearing(const Observation& seen,
                                    const AxisArray& limit_m) const noexcept {
  Finding farthest{Fault::kNone, -1, 0.0, limit_m[0]};
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    const double x_m = seen.position_m[2 * b];
    const double y_m = seen.position_m[2 * b + 1];
    const double radius_m = std::sqrt(x_m * x_m + y_m * y_m);
    if (radius_m * farthest.limit <= farthest.value * limit_m[b]) continue;
    farthest.value = radius_m;
    farthest.limit = limit_m[b];
    farthest.axis = static_cast<std::int8_t>(2 * b + (std::abs(x_m) >= std::abs(y_m) ? 0 : 1));
  }
  return farthest;
}

}  // namespace levitas::supervisor
