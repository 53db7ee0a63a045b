#include "hil/gpio/key_phasor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace levitas::gpio {

namespace {
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kNever = std::numeric_limits<double>::infinity();

double Seconds(std::int64_t ns) noexcept { return static_cast<double>(ns) * 1e-9; }

double Wrapped(double angle_rad) noexcept {
  const double rest_rad = std::fmod(angle_rad, kTurn);
  return rest_rad < 0.0 ? std::min(rest_rad + kTurn, std::nextafter(kTurn, 0.0)) : rest_rad;
}

/// The rotor `time_s` later at the same speed.
SpeedReading TurnedOn(SpeedReading reading, double time_s) noexcept {
  reading.angle_rad = Wrapped(reading.angle_rad + reading.speed_rad_per_s * time_s);
  return reading;
}
}  // namespace

KeyPhasor::KeyPhasor(const KeyPhasorConfig& config) noexcept
    : config_(config), spacing_rad_(kTurn / std::max<std::uint32_t>(1, config.pulses_per_turn)) {
  config_.pulses_per_turn = std::max<std::uint32_t>(1, config.pulses_per_turn);
  config_.max_acceleration_rad_per_s2 =
      std::max(config.max_acceleration_rad_per_s2, kLeastAccelerationRadPerS2);
}

// Roots of w T +- A T^2 / 2 = angle, in the form that does not subtract nearly equal numbers.
KeyPhasor::Window KeyPhasor::WindowOf(int marks, double speed_rad_per_s,
                                      double previous_s) const noexcept {
  const double angle_rad = marks * spacing_rad_;
  const double twice = 2.0 * config_.max_acceleration_rad_per_s2 * angle_rad;
  const double square = speed_rad_per_s * speed_rad_per_s;
  const double soonest_s = 2.0 * angle_rad / (speed_rad_per_s + std::sqrt(square + twice));
  const double latest_s =
      square > twice ? 2.0 * angle_rad / (speed_rad_per_s + std::sqrt(square - twice)) : kNever;
  // Two stamps bound the interval; the speed it is held against has the error of two more.
  const auto slack_s = [&](double interval_s) {
    return 2.0 * config_.jitter_s * (1.0 + interval_s / previous_s);
  };
  return {soonest_s - slack_s(soonest_s),
          latest_s == kNever ? kNever : latest_s + slack_s(latest_s)};
}

KeyPhasor::Verdict KeyPhasor::Judge(double interval_s, int& marks) const noexcept {
  for (marks = 1; marks <= kMaxMissing + 1; ++marks) {
    const Window window = WindowOf(marks, speed_rad_per_s_, interval_s_);
    if (interval_s < window.from_s) return marks == 1 ? Verdict::kEarly : Verdict::kJump;
    if (interval_s <= window.to_s) return Verdict::kFits;
  }
  return Verdict::kJump;
}

// Could one rotor have made both intervals? The speed at the pulse between them is only known to
// within half an interval of acceleration.
bool KeyPhasor::Agree(double first_s, double second_s) const noexcept {
  if (!(first_s > 0.0) || !(second_s > 0.0)) return false;
  const double mean_rad_per_s = spacing_rad_ / first_s;
  const double half_rad_per_s = config_.max_acceleration_rad_per_s2 * first_s / 2.0;
  const Window fastest = WindowOf(1, mean_rad_per_s + half_rad_per_s, first_s);
  const Window slowest = WindowOf(1, std::max(0.0, mean_rad_per_s - half_rad_per_s), first_s);
  return second_s >= fastest.from_s && second_s <= slowest.to_s;
}

void KeyPhasor::FollowRaw(std::int64_t time_ns) noexcept {
  if (raw_ns_) {
    const double interval_s = Seconds(time_ns - *raw_ns_);
    raw_agreeing_ = Agree(raw_last_s_, interval_s) ? raw_agreeing_ + 1 : 1;
    raw_before_s_ = raw_last_s_;
    raw_last_s_ = interval_s;
  }
  raw_ns_ = time_ns;
}

void KeyPhasor::Accept(std::int64_t time_ns, double interval_s, int marks) noexcept {
  const double mean_rad_per_s = marks * spacing_rad_ / interval_s;
  const double limit = config_.max_acceleration_rad_per_s2;
  acceleration_rad_per_s2_ = std::clamp(
      (mean_rad_per_s - mean_rad_per_s_) / ((interval_s + interval_s_) / 2.0), -limit, limit);
  speed_rad_per_s_ = std::max(0.0, mean_rad_per_s + acceleration_rad_per_s2_ * interval_s / 2.0);
  mean_rad_per_s_ = mean_rad_per_s;
  interval_s_ = interval_s;
  last_ns_ = time_ns;
  mark_ = (mark_ + static_cast<std::uint32_t>(marks)) % config_.pulses_per_turn;
  counters_.missing += static_cast<std::uint64_t>(marks - 1);
  ++counters_.good;
  if (marks > 1) {
    Doubt(2 * (marks - 1));
  } else {
    score_ = std::max(0, score_ - 1);
  }
}

void KeyPhasor::Doubt(int points) noexcept {
  score_ += points;
  if (score_ >= kScoreLimit) {
    state_ = SpeedState::kUnknown;
    raw_agreeing_ = 0;
  }
}

// From the last two raw intervals.
void KeyPhasor::Lock(std::int64_t time_ns) noexcept {
  state_ = SpeedState::kLocked;
  score_ = 0;
  mean_rad_per_s_ = spacing_rad_ / raw_before_s_;
  interval_s_ = raw_before_s_;
  Accept(time_ns, raw_last_s_, 1);
}

void KeyPhasor::Pulse(std::int64_t time_ns) noexcept {
  if (raw_ns_ && time_ns <= *raw_ns_) {
    ++counters_.extra;
    return;
  }
  if (state_ == SpeedState::kStanding) {
    state_ = SpeedState::kAcquiring;
    raw_ns_.reset();
    raw_last_s_ = 0.0;
    raw_agreeing_ = 0;
    mark_ = 0;
  }
  FollowRaw(time_ns);
  if (state_ != SpeedState::kLocked) {
    // The first lock needs two intervals that agree; after a contradiction it needs more.
    const int needed = state_ == SpeedState::kAcquiring ? 2 : kAgreeing;
    if (raw_agreeing_ >= needed) {
      Lock(time_ns);
    } else if (state_ == SpeedState::kAcquiring) {
      last_ns_ = time_ns;
    }
    return;
  }
  int marks = 1;
  const double interval_s = Seconds(time_ns - last_ns_);
  switch (Judge(interval_s, marks)) {
    case Verdict::kFits:
      Accept(time_ns, interval_s, marks);
      break;
    case Verdict::kEarly:
      ++counters_.extra;
      Doubt(2);
      break;
    case Verdict::kJump:
      ++counters_.jumps;
      Doubt(2);
      break;
  }
}

SpeedReading KeyPhasor::Predicted(double elapsed_s) const noexcept {
  // A rotor that slows down stops; it does not turn back.
  const double a = acceleration_rad_per_s2_;
  const double until_s = a < 0.0 ? std::min(elapsed_s, -speed_rad_per_s_ / a) : elapsed_s;
  return {.speed_rad_per_s = std::max(0.0, speed_rad_per_s_ + a * until_s),
          .angle_rad = Wrapped(config_.angle_rad + mark_ * spacing_rad_ +
                               speed_rad_per_s_ * until_s + 0.5 * a * until_s * until_s),
          .state = state_};
}

SpeedReading KeyPhasor::At(std::int64_t time_ns) noexcept {
  const double elapsed_s = Seconds(time_ns - last_ns_);
  // As long as no mark passes, the rotor is slower than one spacing in that time.
  const double bound_rad_per_s = elapsed_s > 0.0 ? spacing_rad_ / elapsed_s : kNever;
  if (state_ == SpeedState::kLocked) {
    const Window next = WindowOf(1, speed_rad_per_s_, interval_s_);
    if (next.to_s == kNever) {
      if (bound_rad_per_s < kStandingRadPerS) {
        state_ = SpeedState::kStanding;
        speed_rad_per_s_ = acceleration_rad_per_s2_ = 0.0;
      }
      SpeedReading reading = Predicted(std::max(0.0, elapsed_s));
      reading.speed_rad_per_s = std::min(reading.speed_rad_per_s, bound_rad_per_s);
      reading.state = state_;
      return reading;
    }
    if (elapsed_s > (kMaxMissing + 1) * next.to_s) {
      counters_.missing += kMaxMissing + 1;
      Doubt(kScoreLimit);
    }
    // An overdue mark is a missing pulse, not a rotor that has slowed down.
    if (elapsed_s > next.to_s) {
      SpeedReading reading = TurnedOn(Predicted(next.to_s), elapsed_s - next.to_s);
      reading.state = state_;
      return reading;
    }
    return Predicted(std::max(0.0, elapsed_s));
  }
  if (state_ == SpeedState::kAcquiring && bound_rad_per_s < kStandingRadPerS) {
    state_ = SpeedState::kStanding;
  }
  if (state_ == SpeedState::kAcquiring) {
    const double mean_rad_per_s = raw_last_s_ > 0.0 ? spacing_rad_ / raw_last_s_ : 0.0;
    return {.speed_rad_per_s = std::min(mean_rad_per_s, bound_rad_per_s),
            .angle_rad = Wrapped(config_.angle_rad),
            .state = state_};
  }
  SpeedReading held = Predicted(0.0);
  if (state_ == SpeedState::kStanding) held.speed_rad_per_s = 0.0;
  held.state = state_;
  return held;
}

}  // namespace levitas::gpio
