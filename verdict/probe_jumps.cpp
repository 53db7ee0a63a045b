#include "verdict/probe_jumps.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include "plant_sim/plant/linear_model.hpp"

namespace levitas::verdict {
namespace {

constexpr double kOfClearance = 0.1;
/// Until a slow probe has shown a whole step, before the law has moved the rotor.
constexpr double kSpreadS = 0.4e-3;
/// Slow for every mode of a rotor, and not zero: shafts may turn freely.
constexpr double kNearlyStaticRadPerS = 1.0;

Eigen::MatrixXd StaticResponse(const plant::PlantConfig& plant) {
  const plant::LinearModel model = plant::Linearise(plant, 0.0);
  Eigen::MatrixXcd dynamic = -model.a.cast<std::complex<double>>();
  dynamic.diagonal().array() += std::complex<double>(0.0, kNearlyStaticRadPerS);
  const Eigen::MatrixXcd states =
      dynamic.partialPivLu().solve(model.b.cast<std::complex<double>>());
  return model.c * states.real();
}

}  // namespace

ProbeJumps::ProbeJumps(const configuration::RigFile& rig, double standstill_rad_per_s,
                       double settle_s)
    : frame_(rig.numbers),
      channels_(rig.numbers.channels),
      period_s_(rig.numbers.period_s()),
      splitter_(standstill_rad_per_s, Cycles(settle_s - kBeforeS)),
      place_per_current_m_per_a_(StaticResponse(rig.plant)),
      axes_(channels_.size()) {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    axes_[i].clearance_m = rig.numbers.ClearanceOf(i / 2);
    axes_[i].limit_m = kOfClearance * axes_[i].clearance_m;
  }
}

std::uint64_t ProbeJumps::Cycles(double time_s) const noexcept {
  return static_cast<std::uint64_t>(std::llround(std::max(time_s, 0.0) / period_s_));
}

void ProbeJumps::BreakOff(std::size_t at) {
  const Axis& axis = axes_[at];
  if (!axis.pending || std::abs(axis.pending->step_m) < axis.limit_m) return;
  broken_off_.push_back(
      {.channel = channels_[at],
       .time_s = static_cast<double>(axis.pending->first - *first_cycle_) * period_s_,
       .step_m = axis.pending->step_m,
       .moved_m = {}});
}

void ProbeJumps::Forget() noexcept {
  for (Axis& axis : axes_) {
    axis.earlier = axis.recent = {};
    axis.pending.reset();
    axis.jumped_m = 0.0;
  }
}

void ProbeJumps::Add(const cycle::CycleRecord& record) {
  const std::uint64_t cycle = record.in.cycle;
  if (!first_cycle_) first_cycle_ = cycle;
  const Phase phase = splitter_.Next(cycle, record.out.mode, record.in.frame.speed_rad_per_s);
  if (phase == Phase::kNotJudged) {
    for (std::size_t i = 0; i < axes_.size(); ++i) BreakOff(i);
    Forget();
  }
  if (phase == Phase::kNotJudged || !record.in.frame_present) {
    previous_.reset();
    return;
  }
  const bool follows = previous_ && cycle == *previous_ + 1;
  previous_ = cycle;
  const session::AxisSample sample = frame_.Bearing(record);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double reading_m = sample.position_m[i];
    if (!std::isfinite(reading_m)) {
      previous_.reset();
      continue;
    }
    if (follows) AddStep(axes_[i], reading_m, cycle);
    AddMeans(i, reading_m, sample.current_a, cycle);
    axes_[i].last_m = reading_m;
  }
}

void ProbeJumps::AddStep(Axis& axis, double reading_m, std::uint64_t cycle) {
  const double step_m = reading_m - axis.last_m;
  const double usual_m2 = axis.steps > 0 ? axis.square_m2 / static_cast<double>(axis.steps) : 0.0;
  const double limit_m = std::max(axis.limit_m, kOfSteps * std::sqrt(usual_m2));
  const bool large = std::abs(step_m) > limit_m;
  if (!large) {
    axis.square_m2 += step_m * step_m;
    ++axis.steps;
  }
  if (!axis.pending) {
    if (large && axis.earlier.cycles > 0)
      axis.pending = Pending{cycle, cycle, step_m, axis.earlier, {}};
    return;
  }
  Pending& pending = *axis.pending;
  if (large) {
    pending.last = cycle;
    pending.after = {};
  }
  if (cycle < pending.last + std::max<std::uint64_t>(1, Cycles(kSpreadS))) {
    if (cycle > pending.first) pending.step_m += step_m;
  } else if (std::abs(pending.step_m) < limit_m) {
    axis.earlier = pending.before;  // it is what it was
    axis.recent = {};
    axis.pending.reset();
  }
}

void ProbeJumps::Average(Mean& mean, double reading_m, const AxisArray& current_a) const noexcept {
  const double share = 1.0 / static_cast<double>(++mean.cycles);
  mean.reading_m += share * (reading_m - mean.reading_m);
  for (std::size_t j = 0; j < axes_.size(); ++j)
    mean.current_a[j] += share * (current_a[j] - mean.current_a[j]);
}

void ProbeJumps::AddMeans(std::size_t at, double reading_m, const AxisArray& current_a,
                          std::uint64_t cycle) {
  Axis& axis = axes_[at];
  const std::uint64_t window = Cycles(kBeforeS);
  if (!axis.pending) {
    Average(axis.recent, reading_m, current_a);
    if (axis.recent.cycles < window) return;
    axis.earlier = axis.recent;
    axis.recent = {};
    return;
  }
  if (cycle < axis.pending->last + Cycles(kSettleS)) return;
  Average(axis.pending->after, reading_m, current_a);
  if (axis.pending->after.cycles < window) return;
  Judge(at);
  axis.earlier = axis.pending->after;
  axis.recent = {};
  axis.pending.reset();
}

void ProbeJumps::Judge(std::size_t at) {
  Axis& axis = axes_[at];
  const Pending& p = *axis.pending;
  double placed_m = 0.0;
  for (std::size_t j = 0; j < axes_.size(); ++j) {
    placed_m +=
        place_per_current_m_per_a_(static_cast<Eigen::Index>(at), static_cast<Eigen::Index>(j)) *
        (p.after.current_a[j] - p.before.current_a[j]);
  }
  const double moved_m = p.after.reading_m - p.before.reading_m - placed_m;
  const double agree_m = kAgree * std::abs(p.step_m);
  const bool jumped = std::abs(moved_m - p.step_m) < agree_m;
  const bool touches = !jumped && std::abs(p.after.reading_m - axis.jumped_m - p.step_m) >
                                      kInContact * axis.clearance_m;
  if (!jumped && !touches) return;
  ProbeJump found{.channel = channels_[at],
                  .time_s = static_cast<double>(p.first - *first_cycle_) * period_s_,
                  .step_m = p.step_m,
                  .current_a = p.after.current_a[at] - p.before.current_a[at],
                  .moved_m = {},
                  .returns = std::abs(axis.jumped_m + p.step_m) < agree_m};
  if (jumped) found.moved_m = moved_m;
  axis.jumped_m += p.step_m;
  found_.push_back(found);
}

}  // namespace levitas::verdict
