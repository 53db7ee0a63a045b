#include "controller/supervisor/speed_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "common/frames.hpp"

namespace levitas::supervisor {
namespace {

std::uint64_t WholePeriods(double time_s, double period_s) noexcept {
  return static_cast<std::uint64_t>(std::max(1.0, std::ceil(time_s / period_s - 1e-6)));
}

// What began with this reading has lasted for one period; a long gap proves nothing of its middle.
std::uint64_t Longer(std::uint64_t periods, std::uint64_t since_fresh) noexcept {
  constexpr std::uint64_t kLongestGap = 10;
  return periods == 0 ? 1 : periods + std::min(since_fresh, kLongestGap);
}

}  // namespace

SpeedWatch::SpeedWatch(const RigNumbers& rig, const SequenceConfig& config)
    : period_s_(rig.period_s()),
      standstill_rad_per_s_(config.standstill_rad_per_s),
      margin_rad_per_s_(std::max(kMargin * rig.max_speed_rad_per_s, config.standstill_rad_per_s)),
      rate_rad_per_s2_(kRate * rig.max_acceleration_rad_per_s2),
      max_brake_rad_per_s2_(rig.max_acceleration_rad_per_s2) {
  if (!(config.standstill_s > 0.0 && config.standstill_s < 1e6)) {
    throw std::invalid_argument("supervisor: standstill_s must be greater than 0");
  }
  standstill_cycles_ = WholePeriods(config.standstill_s, period_s_);
  turning_cycles_ = WholePeriods(kTurningS, period_s_);
}

double SpeedWatch::Magnitude() const noexcept { return std::abs(believed_rad_per_s_); }

void SpeedWatch::Forget() noexcept {
  known_ = lost_ = false;
  believed_rad_per_s_ = 0.0;
  standing_ = turning_ = contradicted_ = unchanged_ = age_ = since_fresh_ = 0;
}

bool SpeedWatch::Near(double speed_rad_per_s, double from_rad_per_s,
                      std::uint64_t periods) const noexcept {
  return std::abs(speed_rad_per_s - from_rad_per_s) <=
         margin_rad_per_s_ + rate_rad_per_s2_ * period_s_ * static_cast<double>(periods);
}

std::uint64_t SpeedWatch::WindowCycles() const noexcept {
  const double turn_s = 2.0 * std::numbers::pi / std::max(Magnitude(), 1e-3);
  return WholePeriods(std::clamp(kTurns * turn_s, kShortestS, kLongestS), period_s_);
}

Finding SpeedWatch::Contradiction() const noexcept { return contradiction_; }

void SpeedWatch::Update(const Observation& seen, double brake_rad_per_s2) noexcept {
  const std::uint64_t periods = 1 + std::uint64_t{seen.missed_deadlines};
  age_ += periods;
  since_fresh_ += periods;
  unchanged_ += periods;
  if (lost_) {
    const double brake_rad_per_s2_most = std::min(brake_rad_per_s2, max_brake_rad_per_s2_);
    lowest_rad_per_s_ -=
        brake_rad_per_s2_most / kBrakeMargin * period_s_ * static_cast<double>(periods);
  }
  if (!seen.fresh) return;
  if ((seen.rig_status & kRigSpeedUnknown) != 0) {
    standing_ = turning_ = agreeing_ = 0;
  } else if (lost_) {
    Regain(seen.speed_rad_per_s, since_fresh_);
  } else {
    Judge(seen.speed_rad_per_s, since_fresh_);
  }
  since_fresh_ = 0;
}

void SpeedWatch::Judge(double speed_rad_per_s, std::uint64_t since_fresh) noexcept {
  const bool finite = std::isfinite(speed_rad_per_s);
  if (finite && (!known_ || Near(speed_rad_per_s, believed_rad_per_s_, age_))) {
    Believe(speed_rad_per_s, since_fresh);
    return;
  }
  contradicted_ += since_fresh;
  if (contradicted_ < WindowCycles()) return;
  const bool rises = finite && std::abs(speed_rad_per_s) > Magnitude() &&
                     Near(speed_rad_per_s, believed_rad_per_s_, unchanged_);
  if (rises) {
    Believe(speed_rad_per_s, since_fresh);
  } else {
    Lose(speed_rad_per_s);
  }
}

void SpeedWatch::Believe(double speed_rad_per_s, std::uint64_t since_fresh) noexcept {
  if (!known_ || speed_rad_per_s != believed_rad_per_s_) unchanged_ = 0;
  known_ = true;
  lost_ = false;
  believed_rad_per_s_ = speed_rad_per_s;
  age_ = contradicted_ = 0;
  const bool slow = Magnitude() < standstill_rad_per_s_;
  standing_ = slow ? Longer(standing_, since_fresh) : 0;
  turning_ = slow ? 0 : Longer(turning_, since_fresh);
}

void SpeedWatch::Lose(double speed_rad_per_s) noexcept {
  const double reach_rad_per_s =
      margin_rad_per_s_ + rate_rad_per_s2_ * period_s_ * static_cast<double>(age_);
  const double read_rad_per_s = std::isfinite(speed_rad_per_s) ? std::abs(speed_rad_per_s) : 0.0;
  const double nearest_rad_per_s = read_rad_per_s > Magnitude()
                                       ? Magnitude() + reach_rad_per_s
                                       : std::max(0.0, Magnitude() - reach_rad_per_s);
  contradiction_ = {Fault::kSpeedUnknown, -1, read_rad_per_s,
                    std::isfinite(nearest_rad_per_s) ? nearest_rad_per_s : 0.0};
  lost_ = true;
  lowest_rad_per_s_ = Magnitude();
  candidate_rad_per_s_ = std::numeric_limits<double>::quiet_NaN();
  standing_ = turning_ = agreeing_ = 0;
}

// Near is false for a candidate that is no number.
void SpeedWatch::Regain(double speed_rad_per_s, std::uint64_t since_fresh) noexcept {
  const bool agrees = std::isfinite(speed_rad_per_s) &&
                      Near(speed_rad_per_s, candidate_rad_per_s_, since_fresh) &&
                      std::abs(speed_rad_per_s) + margin_rad_per_s_ >= lowest_rad_per_s_;
  candidate_rad_per_s_ = speed_rad_per_s;
  agreeing_ = agrees ? Longer(agreeing_, since_fresh) : 0;
  if (agreeing_ >= standstill_cycles_) Believe(speed_rad_per_s, since_fresh);
}

}  // namespace levitas::supervisor
