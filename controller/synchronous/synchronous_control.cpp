#include "controller/synchronous/synchronous_control.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace levitas::synchronous {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;
constexpr double kFadeTurns = 0.5;
constexpr double kLongestFadeS = 0.2;
constexpr double kLongestSlowFadeS = 1.0;
/// A clipped current is at its limit twice a period, not all the time: a cycle without counts back
/// a quarter of one with.
constexpr double kCountBack = 0.25;
/// Of the supervisor's orbit limit.
constexpr double kBelowTrip = 0.85;
constexpr double kRunOutFadeS = 0.1;
/// Time constants after which a block has done most of what it does to the orbit, also one that is
/// slower by its T (amb design notch accepts a fifth of the rate).
constexpr double kSettled = 10.0;
/// Time constants of a block in one of what follows the orbit that it leaves.
constexpr double kFollowed = 30.0;
/// Of a block that corrects its T, while it has not seen yet what it does.
constexpr double kBeginningPace = 0.25;

}  // namespace

SynchronousControl::Block::Block(const BlockConfig& config, std::size_t axes, double period_s)
    : inverse(config),
      order(config.order),
      target(config.target),
      time_constant_s(config.time_constant_s),
      rate(2.0 * period_s / config.time_constant_s),
      slow_fade(period_s / std::min(config.time_constant_s, kLongestSlowFadeS)),
      from(config.from_rad_per_s),
      to(config.to_rad_per_s),
      hysteresis(config.hysteresis_rad_per_s),
      largest_current_a(config.largest_current_a),
      adaptive(config.adaptive),
      influence(axes, period_s, config.least_change_m) {
  if (!(order > 0.0) || !(config.time_constant_s > 0.0)) {
    throw std::invalid_argument("synchronous: order and time constant must be above zero");
  }
}

SynchronousControl::SynchronousControl(const SynchronousConfig& config, const RigNumbers& rig,
                                       double orbit_trip_fraction)
    : axes_(rig.axes()),
      period_s_(rig.period_s()),
      angle_(config.angle, rig.period_s(), rig.axes()),
      angle_estimated_(config.angle.source == AngleSource::kOrbit),
      orbit_growth_(config.orbit_growth),
      saturated_limit_cycles_(config.saturated_s / rig.period_s()),
      run_outs_(config.run_outs) {
  if (config.blocks.size() > kMaxBlocks) {
    throw std::invalid_argument("synchronous: more blocks than " + std::to_string(kMaxBlocks));
  }
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    least_orbit_m_[b] = config.least_orbit_fraction * rig.ClearanceOf(b);
    most_orbit_m_[b] = kBelowTrip * orbit_trip_fraction * rig.ClearanceOf(b);
  }
  for (const BlockConfig& block : config.blocks) blocks_.emplace_back(block, axes_, period_s_);
}

void SynchronousControl::Reset() noexcept {
  run_out_gain_ = 0.0;
  run_out_fades_ = false;
  saturated_ = {};
  orbit_now_m_ = orbit_turn_m_ = {};
  turned_ = 0.0;
  for (Block& block : blocks_) {
    block.state = {};
    block.influence.Reset();
    block.gain = 0.0;
    block.retries = 0;
    block.status = {};
  }
}

// The largest radius of a turn, bearing by bearing, of a rotor that is held about its centre.
void SynchronousControl::WatchOrbit(const Conditions& seen) noexcept {
  if (!seen.levitated) {
    orbit_now_m_ = orbit_turn_m_ = {};
    turned_ = 0.0;
    return;
  }
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    const double x_m = seen.position_m[2 * b];
    const double y_m = 2 * b + 1 < axes_ ? seen.position_m[2 * b + 1] : 0.0;
    const double radius_m = std::sqrt(x_m * x_m + y_m * y_m);
    if (!(radius_m <= orbit_now_m_[b])) orbit_now_m_[b] = radius_m;
  }
  turned_ += seen.believed_speed_rad_per_s * period_s_ / kWholeTurn;
  if (turned_ < 1.0) return;
  turned_ = 0.0;
  orbit_turn_m_ = orbit_now_m_;
  orbit_now_m_ = {};
}

Ending SynchronousControl::Trouble(const Block& block, const Conditions& seen) const noexcept {
  if (!seen.levitated) return Ending::kNotLevitated;
  if (angle_.trouble() == AngleTrouble::kJumped) return Ending::kAngleJumped;
  if (!angle_.good()) return Ending::kAngleLost;
  for (std::size_t i = 0; i < axes_; ++i) {
    if (saturated_[i] > saturated_limit_cycles_) return Ending::kSaturated;
  }
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    if (!(orbit_now_m_[b] <= block.orbit_limit_m[b])) return Ending::kOrbitGrew;
  }
  if (block.target == Target::kVibration && !(block.status.amplitude <= block.largest_current_a)) {
    return Ending::kCurrentTooLarge;
  }
  if (angle_.speed_rad_per_s() <= 0.0 || block.Left(seen.believed_speed_rad_per_s)) {
    return Ending::kSpeed;
  }
  return Ending::kNone;
}

// Before another trial the orbit is back near what it was when the block began the first time.
bool SynchronousControl::Calm(const Block& block) const noexcept {
  const double share = std::min(0.95, 1.3 / orbit_growth_);
  if (angle_estimated_) return true;
  for (std::size_t b = 0; 2 * b < axes_ && block.retries > 0; ++b) {
    if (!(std::max(orbit_turn_m_[b], orbit_now_m_[b]) <= share * block.orbit_limit_m[b])) {
      return false;
    }
  }
  return true;
}

void SynchronousControl::Begin(Block& block) noexcept {
  block.state = {};
  block.influence.Restart();
  block.gain = 1.0;
  block.status.state = BlockState::kActing;
  if (ChangesFollowedOrbit(block.order)) angle_.Coast(kSettled * block.time_constant_s);
  // After a trial that grew the orbit the limit of the first time holds.
  if (block.retries > 0 && !angle_estimated_) return;
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    const double begun_m = std::max(orbit_turn_m_[b], orbit_now_m_[b]);
    block.orbit_limit_m[b] =
        std::min(std::max(orbit_growth_ * begun_m, least_orbit_m_[b]), most_orbit_m_[b]);
  }
}

void SynchronousControl::End(Block& block, Ending why) noexcept {
  block.status.state = BlockState::kFading;
  block.status.ending = why;
  block.fast = why != Ending::kSpeed;
  if (ChangesFollowedOrbit(block.order)) {
    angle_.Coast(block.fast ? kLongestFadeS : period_s_ / block.slow_fade);
  }
}

void SynchronousControl::Fade(Block& block) noexcept {
  double share = block.slow_fade;
  if (block.fast) {
    const double turns = std::abs(angle_.speed_rad_per_s()) * period_s_ / kWholeTurn;
    share = std::max(turns / kFadeTurns, period_s_ / kLongestFadeS);
  }
  block.gain -= share;
  if (block.gain > 0.0) return;
  block.gain = 0.0;
  block.state = {};
  block.status.amplitude = 0.0;
  const Ending why = block.status.ending;
  const bool angle = why == Ending::kAngleLost || why == Ending::kAngleJumped;
  const bool learned = block.adaptive && why == Ending::kOrbitGrew && block.influence.learned() > 0;
  const bool retried = (learned || (angle && angle_estimated_)) && block.retries < kRetries;
  if (retried) ++block.retries;
  if (why == Ending::kSpeed) block.retries = 0;
  const bool again = retried || why == Ending::kSpeed || (angle && !angle_estimated_) ||
                     why == Ending::kNotLevitated;
  block.status.state = again ? BlockState::kOff : BlockState::kEnded;
}

void SynchronousControl::CountSaturation(const Conditions& seen) noexcept {
  for (std::size_t i = 0; i < axes_; ++i) {
    const bool limited = (seen.saturated_axes & (1U << i)) != 0;
    saturated_[i] = limited ? std::min(saturated_[i] + 1.0, 2.0 * saturated_limit_cycles_)
                            : std::max(saturated_[i] - kCountBack, 0.0);
  }
}

// Once it goes it goes to the end: the angle it comes back with may be another.
void SynchronousControl::FadeRunOut(bool wanted) noexcept {
  if (run_outs_.empty()) return;
  if (!wanted) run_out_fades_ = true;
  const double step = period_s_ / kRunOutFadeS;
  run_out_gain_ = std::clamp(run_out_gain_ + (run_out_fades_ ? -step : step), 0.0, 1.0);
  if (run_out_gain_ == 0.0 && wanted) run_out_fades_ = false;
}

void SynchronousControl::Supervise(const Conditions& seen) noexcept {
  CountSaturation(seen);
  const double speed = seen.believed_speed_rad_per_s;
  for (Block& block : blocks_) {
    const bool within = speed >= block.from && speed <= block.to;
    const bool left = block.Left(speed);
    Ending why = Ending::kNone;
    switch (block.status.state) {
      case BlockState::kOff:
        if (left) block.retries = 0;
        if (within && seen.levitated && angle_.good() && angle_.speed_rad_per_s() > 0.0 &&
            Calm(block)) {
          Begin(block);
        }
        break;
      case BlockState::kActing:
        why = Trouble(block, seen);
        break;
      case BlockState::kFading:  // what fades slowly is watched to its end
        if (!block.fast) why = Trouble(block, seen);
        if (why == Ending::kSpeed) why = Ending::kNone;
        break;
      case BlockState::kEnded:
        if (left) {
          block.status.state = BlockState::kOff;
          block.retries = 0;
        }
        break;
    }
    if (why != Ending::kNone) End(block, why);
    if (block.status.state == BlockState::kFading) Fade(block);
  }
  FadeRunOut(seen.levitated && angle_.good());
  PaceAngle();
}

// Blocks come and go: what follows the orbit is as slow as the slowest that changes it asks.
void SynchronousControl::PaceAngle() noexcept {
  if (!angle_estimated_) return;
  double slowest_s = 0.0;
  for (const Block& block : blocks_) {
    if (block.gain == 0.0 || !ChangesFollowedOrbit(block.order)) continue;
    slowest_s = std::max(slowest_s, block.time_constant_s);
  }
  angle_.FollowWithin(kFollowed * slowest_s);
}

void SynchronousControl::Wait(const Conditions& seen) noexcept {
  if (empty()) return;
  angle_.Update(seen.angle, seen.position_m);
  Supervise(seen);
}

void SynchronousControl::Step(const Conditions& seen, AxisArray& error_m,
                              AxisArray& added_a) noexcept {
  if (empty()) return;
  angle_.Update(seen.angle, seen.position_m);
  WatchOrbit(seen);
  Supervise(seen);
  for (const RunOut& run_out : run_outs_) {
    if (run_out_gain_ == 0.0) break;
    const UnitPhasor phasor = PhasorOfTurns(angle_.TurnsOf(run_out.order));
    AddTurning(run_out.real_m, run_out.imaginary_m, phasor, run_out_gain_, error_m);
  }
  std::array<UnitPhasor, kMaxBlocks> phasors;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    Block& block = blocks_[k];
    if (block.gain == 0.0) continue;
    phasors[k] = PhasorOfTurns(angle_.TurnsOf(block.order));
    if (block.target == Target::kCurrent) {
      AddTurning(block.state.real, block.state.imaginary, phasors[k], -block.gain, error_m);
    } else {
      AddTurning(block.state.real, block.state.imaginary, phasors[k], block.gain, added_a);
    }
  }
  const double turns = std::abs(angle_.speed_rad_per_s()) * period_s_ / kWholeTurn;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    Block& block = blocks_[k];
    if (block.status.state != BlockState::kActing || seen.saturated_axes != 0) continue;
    const InverseLanes* inverse = &block.inverse.At(seen.believed_speed_rad_per_s);
    if (block.adaptive) {
      block.influence.Observe(*inverse, phasors[k], turns, error_m, block.state);
      inverse = &block.influence.Corrected(*inverse);
    }
    const bool cautious = block.adaptive && block.influence.beginning();
    const double rate = cautious ? kBeginningPace * block.rate : block.rate;
    Adapt(*inverse, phasors[k], rate, axes_, error_m, block.state);
    block.status.amplitude = LargestAmplitude(block.state);
  }
}

}  // namespace levitas::synchronous
