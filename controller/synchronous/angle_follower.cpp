#include "controller/synchronous/angle_follower.hpp"

#include <cmath>
#include <numbers>

namespace levitas::synchronous {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Beside the share: a rotor that hardly turns has no speed to take a share of.
constexpr double kSpeedMargin = 2.0;  // [rad/s]

}  // namespace

AngleFollower::AngleFollower(const AngleConfig& config, double period_s) noexcept
    : source_(config.source),
      period_s_(period_s),
      largest_error_turns_(config.largest_error_rad / kTurn),
      largest_speed_share_(config.largest_speed_share),
      angle_gain_(2.0 * kTurn * config.bandwidth_hz * period_s),
      speed_gain_(kTurn * config.bandwidth_hz * kTurn * config.bandwidth_hz * period_s) {}

void AngleFollower::Angle::Advance(double turns) noexcept {
  within += turns;
  const double carried = std::floor(within);
  whole += carried;
  within -= carried;
}

void AngleFollower::Begin(const AngleReading& reading) noexcept {
  followed_.within = 0.0;
  followed_.Advance(reading.angle_rad / kTurn);
  followed_.speed_rad_per_s = reading.speed_rad_per_s;
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

void AngleFollower::Update(const AngleReading& reading) noexcept {
  trouble_ = AngleTrouble::kNone;
  const double dt_s = period_s_ * static_cast<double>(reading.periods);
  flywheel_.Advance(flywheel_.speed_rad_per_s * dt_s / kTurn);
  const double step_turns = followed_.speed_rad_per_s * dt_s / kTurn;
  if (begun_) followed_.Advance(step_turns);
  if (!reading.fresh) {
    silent_turns_ += std::abs(step_turns);
    if (begun_ && silent_turns_ > kSilentTurns) Break(AngleTrouble::kLost);
    return;
  }
  const bool readable = !reading.speed_unknown && std::isfinite(reading.angle_rad) &&
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
  if (source_ == AngleSource::kSpeed) {
    followed_.speed_rad_per_s = reading.speed_rad_per_s;
    good_turns_ += std::abs(step_turns);
    return;
  }
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

double AngleFollower::TurnsOf(double order) const noexcept {
  const Angle& angle = good() ? followed_ : flywheel_;
  const double of_whole = order * angle.whole;
  return of_whole - std::floor(of_whole) + order * angle.within;
}

}  // namespace levitas::synchronous
