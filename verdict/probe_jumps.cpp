#include "verdict/probe_jumps.hpp"

#include <algorithm>
#include <cmath>

#include "plant_sim/plant/find_operating_point.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::verdict {
namespace {

constexpr double kOfClearance = 0.1;
constexpr double kOfSteps = 8.0;
/// Cycles until a slow probe has shown the whole step, before the law has moved the rotor.
constexpr std::uint64_t kSpread = 4;

}  // namespace

ProbeJumps::ProbeJumps(const config::RigFile& rig, double standstill_rad_per_s, double settle_s)
    : frame_(rig.numbers),
      channels_(rig.numbers.channels),
      period_s_(rig.numbers.period_s()),
      splitter_(standstill_rad_per_s, Cycles(settle_s)) {
  const plant::PlantModel model(plant::Reduce(rig.plant));
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const plant::Slopes slopes = plant::SlopesAt(model, i / 2, {});
    const auto own = static_cast<Eigen::Index>(i % 2);
    Axis axis;
    axis.ki_n_per_a = slopes.current(own, own);
    axis.ks_n_per_m = slopes.displacement(own, own);
    axis.clearance_m = rig.numbers.ClearanceOf(i / 2);
    axes_.push_back(axis);
  }
}

std::uint64_t ProbeJumps::Cycles(double time_s) const noexcept {
  return static_cast<std::uint64_t>(std::llround(std::max(time_s, 0.0) / period_s_));
}

void ProbeJumps::Forget() noexcept {
  for (Axis& axis : axes_) {
    axis.earlier = axis.recent = {};
    axis.pending.reset();
  }
}

void ProbeJumps::Add(const cycle::CycleRecord& record) {
  const std::uint64_t cycle = record.in.cycle;
  if (first_cycle_ == 0) first_cycle_ = cycle;
  const Phase phase = splitter_.Next(cycle, record.out.mode, record.in.frame.speed_rad_per_s);
  const bool follows = judged_ && cycle == last_cycle_ + 1;
  last_cycle_ = cycle;
  judged_ = phase != Phase::kNotJudged && record.in.frame_present;
  if (phase == Phase::kNotJudged) Forget();
  if (!judged_) return;
  const session::AxisSample sample = frame_.Bearing(record);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double reading_m = sample.position_m[i];
    if (!std::isfinite(reading_m)) {
      axes_[i].pending.reset();
      continue;
    }
    Look(axes_[i], reading_m, cycle, follows);
    Measure(axes_[i], i, reading_m, sample.current_a[i], cycle);
    axes_[i].last_m = reading_m;
  }
}

void ProbeJumps::Look(Axis& axis, double reading_m, std::uint64_t cycle, bool follows) {
  if (!follows) return;
  const double step_m = reading_m - axis.last_m;
  const double usual_m2 = axis.steps > 0 ? axis.square_m2 / static_cast<double>(axis.steps) : 0.0;
  const double limit_m = std::max(kOfClearance * axis.clearance_m, kOfSteps * std::sqrt(usual_m2));
  if (std::abs(step_m) <= limit_m) {
    axis.square_m2 += step_m * step_m;
    ++axis.steps;
    return;
  }
  if (!axis.pending && axis.earlier.cycles > 0) {
    axis.pending = Pending{cycle, axis.last_m, step_m, axis.earlier, {}};
  }
}

void ProbeJumps::Measure(Axis& axis, std::size_t at, double reading_m, double current_a,
                         std::uint64_t cycle) {
  const std::uint64_t window = Cycles(kBeforeS);
  const auto add = [&](Mean& to) {
    const double share = 1.0 / static_cast<double>(++to.cycles);
    to.reading_m += share * (reading_m - to.reading_m);
    to.current_a += share * (current_a - to.current_a);
  };
  if (!axis.pending) {
    add(axis.recent);
    if (axis.recent.cycles < window) return;
    axis.earlier = axis.recent;
    axis.recent = {};
    return;
  }
  Pending& step = *axis.pending;
  if (cycle < step.cycle + kSpread) step.step_m = reading_m - step.from_m;
  if (cycle < step.cycle + Cycles(kSettleS)) return;
  add(step.after);
  if (step.after.cycles < window) return;
  const double current_step_a = step.after.current_a - step.before.current_a;
  const double moved_m = step.after.reading_m - step.before.reading_m +
                         axis.ki_n_per_a * current_step_a / axis.ks_n_per_m;
  const bool held =
      axis.ks_n_per_m > 0.0 && std::abs(moved_m - step.step_m) < kAgree * std::abs(step.step_m);
  const bool touches =
      !held && std::abs(step.after.reading_m - step.step_m) > kInContact * axis.clearance_m;
  if (held || touches) {
    found_.push_back({channels_[at], static_cast<double>(step.cycle - first_cycle_) * period_s_,
                      step.step_m, current_step_a, held ? moved_m : step.step_m, touches});
  }
  axis.earlier = axis.recent = {};
  axis.pending.reset();
}

}  // namespace levitas::verdict
