#include "controller/synchronous/angle_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace levitas::synchronous {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Beside the share: a rotor that hardly turns has no speed to take a share of.
constexpr double kSpeedMargin = 2.0;  // [rad/s]
/// What angle and slip take of an orbit's error, once a turn.
constexpr double kOrbitPole = 0.8;
/// Of what angle and slip take, what the reference of the orbit takes.
constexpr double kReferencePace = 0.25;
/// An angle that is being found: beyond this the slip has still to be learned.
constexpr double kCloseTurns = 0.02;

/// An error of the angle as orbit_slip.hpp counts it; from half a turn on there is no limit.
double OrbitError(double angle_rad) {
  if (angle_rad >= std::numbers::pi) return std::numeric_limits<double>::infinity();
  return PhasorOfTurns(std::min(angle_rad / kTurn, 0.25)).sine / kTurn;
}

}  // namespace

AngleFollower::AngleFollower(const AngleConfig& config, double period_s, std::size_t axes) noexcept
    : source_(config.source),
      period_s_(period_s),
      largest_error_turns_(config.largest_error_rad / kTurn),
      largest_orbit_error_turns_(OrbitError(config.largest_error_rad)),
      largest_speed_share_(config.largest_speed_share),
      least_followed_m_(config.least_followed_m),
      angle_gain_(2.0 * kTurn * config.bandwidth_hz * period_s),
      speed_gain_(kTurn * config.bandwidth_hz * kTurn * config.bandwidth_hz * period_s),
      orbit_(axes),
      needed_turns_(config.source == AngleSource::kOrbit ? kOrbitTurns : kGoodTurns) {}

void AngleFollower::Angle::Advance(double turns) noexcept {
  within += turns;
  const double carried = std::floor(within);
  whole += carried;
  within -= carried;
}

void AngleFollower::Begin(const AngleReading& reading) noexcept {
  followed_.within = 0.0;
  if (source_ == AngleSource::kRig) followed_.Advance(reading.angle_rad / kTurn);
  followed_.speed_rad_per_s = reading.speed_rad_per_s;
  orbit_.Reset();
  slip_ = 0.0;
  coast_s_ = 0.0;
  unended_turns_ = 0.0;
  begun_ = true;
  silent_turns_ = 0.0;
}

// The flywheel starts from what was followed until now; an angle that was not good leaves it alone.
void AngleFollower::Break(AngleTrouble trouble) noexcept {
  if (good()) flywheel_ = followed_;
  good_turns_ = 0.0;
  begun_ = false;
  trouble_ = trouble;
}

void AngleFollower::Update(const AngleReading& reading, const AxisArray& position_m) noexcept {
  trouble_ = AngleTrouble::kNone;
  const double dt_s = period_s_ * static_cast<double>(reading.periods);
  flywheel_.Advance(flywheel_.speed_rad_per_s * dt_s / kTurn);
  const double step_turns = followed_.speed_rad_per_s * dt_s / kTurn;
  if (begun_) followed_.Advance(step_turns);
  if (!reading.fresh) {
    orbit_.DropTurn();
    silent_turns_ += std::abs(step_turns);
    if (begun_ && silent_turns_ > kSilentTurns) Break(AngleTrouble::kLost);
    return;
  }
  const bool readable = !reading.speed_unknown &&
                        (source_ != AngleSource::kRig || std::isfinite(reading.angle_rad)) &&
                        std::isfinite(reading.speed_rad_per_s);
  if (!readable) {
    if (begun_) Break(AngleTrouble::kLost);
    return;
  }
  if (!begun_) {
    Begin(reading);
    return;
  }
  silent_turns_ = 0.0;
  switch (source_) {
    case AngleSource::kRig:
      return FollowAngle(reading, step_turns);
    case AngleSource::kOrbit:
      return FollowOrbit(reading, step_turns, position_m);
    case AngleSource::kSpeed:
      break;
  }
  followed_.speed_rad_per_s = reading.speed_rad_per_s;
  good_turns_ += std::abs(step_turns);
}

void AngleFollower::FollowAngle(const AngleReading& reading, double step_turns) noexcept {
  const double apart = reading.angle_rad / kTurn - followed_.within;
  const double error_turns = apart - std::floor(apart + 0.5);
  const double off_rad_per_s = std::abs(followed_.speed_rad_per_s - reading.speed_rad_per_s);
  const bool other_speed =
      off_rad_per_s > largest_speed_share_ * std::abs(reading.speed_rad_per_s) + kSpeedMargin;
  if (std::abs(error_turns) > largest_error_turns_ || other_speed) {
    Break(AngleTrouble::kJumped);
    Begin(reading);
    return;
  }
  followed_.Advance(angle_gain_ * error_turns);
  followed_.speed_rad_per_s += speed_gain_ * kTurn * error_turns;
  good_turns_ += std::abs(step_turns);
}

double AngleFollower::OrbitPole() const noexcept {
  const double speed = std::abs(followed_.speed_rad_per_s);
  if (follow_s_ == 0.0 || speed == 0.0) return kOrbitPole;
  return std::max(kOrbitPole, 1.0 - kTurn / speed / follow_s_);
}

// Before it is good an error is not judged: a slip of a tenth is 36 degrees in the first turn.
AngleTrouble AngleFollower::JudgeTurn(const OrbitTurn& turn) const noexcept {
  const double least_m = (good() ? kLeastKeptShare : 1.0) * least_followed_m_;
  if (!(turn.forward_m >= least_m)) return AngleTrouble::kLost;
  const bool off = good() && std::abs(turn.ahead_turns) > largest_orbit_error_turns_;
  return off || std::abs(slip_) > largest_speed_share_ ? AngleTrouble::kJumped
                                                       : AngleTrouble::kNone;
}

void AngleFollower::FollowOrbit(const AngleReading& reading, double step_turns,
                                const AxisArray& position_m) noexcept {
  followed_.speed_rad_per_s = (1.0 + slip_) * reading.speed_rad_per_s;
  if (reading.periods > 1) orbit_.DropTurn();
  const bool steady = std::abs(reading.speed_rad_per_s - reference_speed_rad_per_s_) <=
                      kSteadyShare * reading.speed_rad_per_s;
  const bool coasts = coast_s_ > 0.0 || (follow_s_ > 0.0 && !steady);
  coast_s_ -= period_s_ * static_cast<double>(reading.periods);
  if (coasts || !(step_turns > 0.0)) {
    orbit_.Reset();
    reference_speed_rad_per_s_ = reading.speed_rad_per_s;
    unended_turns_ = 0.0;
    return;
  }
  const double taken = 1.0 - OrbitPole();
  const OrbitTurn turn =
      orbit_.Add(position_m, PhasorOfTurns(followed_.within), step_turns, kReferencePace * taken);
  unended_turns_ += step_turns;
  AngleTrouble trouble = unended_turns_ > kGoodTurns ? AngleTrouble::kLost : AngleTrouble::kNone;
  if (turn.ended) {
    unended_turns_ = 0.0;
    slip_ += taken * taken * turn.ahead_turns;
    trouble = JudgeTurn(turn);
  }
  if (trouble != AngleTrouble::kNone) {
    Break(trouble);
    Begin(reading);
    return;
  }
  if (!turn.ended) return;
  followed_.Advance(taken * (2.0 - taken) * turn.ahead_turns);
  followed_.speed_rad_per_s = (1.0 + slip_) * reading.speed_rad_per_s;
  const bool close = good() || std::abs(turn.ahead_turns) <= kCloseTurns;
  good_turns_ = close ? good_turns_ + 1.0 : 0.0;
}

double AngleFollower::TurnsOf(double order) const noexcept {
  const Angle& angle = good() ? followed_ : flywheel_;
  const double of_whole = order * angle.whole;
  return of_whole - std::floor(of_whole) + order * angle.within;
}

}  // namespace levitas::synchronous
