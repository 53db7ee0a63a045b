#include "controller/law/running_law.hpp"

#include <cmath>
#include <limits>

namespace levitas::law {
namespace {

/// What is left of a fading current below this is nothing, and the law is the plain one again.
constexpr double kGoneA = 1e-9;

}  // namespace

RunningLaw::RunningLaw(const LawConfig& config) : laws_(config) {
  for (std::size_t rung = 0; rung < laws_.size(); ++rung) {
    // Two exchanges within a rung leave the stretch between them without one.
    while (memories_.size() <= laws_.Stretch(rung)) memories_.emplace_back(laws_[rung]);
  }
  const double period_s = config.period_s;
  listen_periods_ = static_cast<std::size_t>(std::lround(kListenS / period_s));
  follow_ = -std::expm1(-period_s / kFollowS);
  fade_ = std::exp(-period_s / kFadeS);
}

void RunningLaw::Start(double speed_rad_per_s) noexcept {
  rung_ = laws_.Nearest(speed_rad_per_s);
  Memory(rung_).Reset();
  listened_ = 0;
  beside_a_ = {};
  given_a_ = {};
}

void RunningLaw::JumpTo(double speed_rad_per_s) noexcept {
  const std::size_t rung = laws_.Nearest(speed_rad_per_s);
  if (laws_.Stretch(rung) != laws_.Stretch(rung_)) {
    const AxisArray before_a = given_a_;
    Start(speed_rad_per_s);
    TakeOver(rung_, before_a);
    return;
  }
  ChangeLaw(laws_[rung_], laws_[rung], Memory(rung));
  rung_ = rung;
}

void RunningLaw::Follow(double speed_rad_per_s) noexcept {
  const std::size_t next = laws_.Next(rung_, speed_rad_per_s);
  if (laws_.Stretch(next) == laws_.Stretch(rung_)) {
    listened_ = 0;
    if (next != rung_) ChangeLaw(laws_[rung_], laws_[next], Memory(rung_));
    rung_ = next;
    return;
  }
  if (listened_ == 0) {
    Memory(next).Reset();
    difference_a_ = {};
    listening_ = next;
  }
  if (listened_ < listen_periods_) return;
  TakeOver(listening_, difference_a_);
}

void RunningLaw::TakeOver(std::size_t rung, const AxisArray& more_a) noexcept {
  rung_ = rung;
  listened_ = 0;
  beside_a_ = more_a;
  if (laws_[rung].state_space()) return;
  for (std::size_t i = 0; i < axes(); ++i) {
    if (laws_[rung].pid().integral.at[i] == 0.0) continue;
    Memory(rung).integral_a.at[i] += more_a[i];
    beside_a_[i] = 0.0;
  }
}

void RunningLaw::Listen(const AxisArray& error_m) noexcept {
  constexpr double kNoLimit = std::numeric_limits<double>::max();
  const LawOutput own = law::Step(laws_[listening_], Memory(listening_), error_m, {}, kNoLimit);
  for (std::size_t i = 0; i < axes(); ++i) {
    const double more_a = given_a_[i] - own.control_current_a[i];
    difference_a_[i] += follow_ * (more_a - difference_a_[i]);
  }
  ++listened_;
}

LawOutput RunningLaw::Step(double speed_rad_per_s, const AxisArray& error_m,
                           const AxisArray& excitation_a, double limit_a) noexcept {
  if (laws_.size() == 1) {
    return law::Step(laws_[0], memories_[0], error_m, excitation_a, limit_a);
  }
  Follow(speed_rad_per_s);
  const bool other = laws_.Stretch(laws_.Next(rung_, speed_rad_per_s)) != laws_.Stretch(rung_);
  AxisArray beside_a = excitation_a;
  for (std::size_t i = 0; i < axes(); ++i) {
    beside_a[i] += beside_a_[i];
    beside_a_[i] = std::abs(beside_a_[i]) > kGoneA ? fade_ * beside_a_[i] : 0.0;
  }
  const LawOutput given = law::Step(laws_[rung_], Memory(rung_), error_m, beside_a, limit_a);
  for (std::size_t i = 0; i < axes(); ++i) {
    given_a_[i] = given.control_current_a[i] - excitation_a[i];
  }
  if (other) Listen(error_m);
  return given;
}

}  // namespace levitas::law
