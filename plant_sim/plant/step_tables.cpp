// The constants of a time step: when the delayed command changes within a period, and the exact
// steps of modes, amplifiers, sensors and effects on either side.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant_sim/effect/eddy_current.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::plant {
namespace {

// Delays closer than this to a whole sample count as whole: a rounding error, not a step of its
// own.
constexpr double kWholeSample = 1e-9;

// A lag this much faster than the substep is immediate; keeps tau = 0 away from the division.
constexpr double kFastestLagHz = 1e12;

void StoreModeStep(std::size_t at, const ModeStep& step, StepTable& table) noexcept {
  table.xx[at] = step.xx;
  table.xv[at] = step.xv;
  table.vx[at] = step.vx;
  table.vv[at] = step.vv;
  table.x0[at] = step.x0;
  table.v0[at] = step.v0;
  table.x1[at] = step.x1;
  table.v1[at] = step.v1;
}

/// Of amplifiers and sensors.
void MakeAxisSteps(const RigNow& now, const EffectModel& effects, StepTable& table) noexcept {
  for (std::size_t axis = 0; axis < table.amplifier.size(); ++axis) {
    table.amplifier[axis] = amplifier::MakeStep(now.amplifier_bandwidth_hz[axis],
                                                now.slew_a_per_s[axis], table.duration_s);
    const ReadingEffects& reading = effects.readings[axis];
    table.sensor[axis] =
        sensor::MakeFilterStep(reading.bandwidth_hz, reading.gain, table.duration_s);
    if (!table.second_order.empty()) {
      table.second_order[axis] = MakeModeStep(2.0 * std::numbers::pi * reading.bandwidth_hz,
                                              sensor::kButterworthDamping, table.duration_s);
    }
  }
}

void MakeEddySteps(const EffectModel& effects, StepTable& table) noexcept {
  for (std::size_t i = 0; i < table.eddy.size(); ++i) {
    const std::size_t axis = i / effect::kEddyLags;
    const double tau_s = effects.bearings[axis / 2].axis[axis % 2].eddy_tau_s;
    const double corner_rad_per_s = effect::Eddy().rate[i % effect::kEddyLags] / tau_s;
    const double corner_hz = std::min(corner_rad_per_s / (2.0 * std::numbers::pi), kFastestLagHz);
    table.eddy[i] = sensor::MakeFilterStep(corner_hz, 1.0, table.duration_s);
  }
}

}  // namespace

void PlantModel::ReserveSteps() {
  const std::size_t axes = 2 * bearings_.size();
  bool eddy = false;
  for (const BearingEffects& bearing : effects_.bearings) {
    for (const MagnetEffects& magnet : bearing.axis) eddy |= magnet.eddy_state != kNoState;
  }
  for (StepTable& table : steps_) {
    for (auto* column :
         {&table.xx, &table.xv, &table.vx, &table.vv, &table.x0, &table.v0, &table.x1, &table.v1}) {
      column->resize(coordinates());
    }
    table.amplifier.resize(axes);
    table.sensor.resize(axes);
    if (layout_.sensor_rates > 0) table.second_order.resize(axes);
    if (eddy) table.eddy.resize(axes * effect::kEddyLags);
    if (effects_.housings) table.housing.resize(bearings_.size());
  }
}

void PlantModel::RefreshDelay() noexcept {
  double whole = std::floor(now_.delay_samples);
  double fraction = now_.delay_samples - whole;
  if (fraction > 1.0 - kWholeSample) whole += 1.0;
  if (fraction < kWholeSample || fraction > 1.0 - kWholeSample) fraction = 0.0;
  whole_delay_ = static_cast<std::size_t>(whole);
  fraction_ = fraction;
}

void PlantModel::RefreshSteps() noexcept {
  RefreshStep(steps_[0], fraction_);
  RefreshStep(steps_[1], 1.0 - fraction_);
}

void PlantModel::RefreshStep(StepTable& table, double share) noexcept {
  table.substeps = 0;
  if (share == 0.0) return;
  const double period_s = static_cast<double>(config().period_ns) * 1e-9;
  table.substeps = std::max(1, static_cast<int>(std::lround(config().substeps * share)));
  table.duration_s = share * period_s / table.substeps;
  const std::size_t modes = layout_.modes;
  const auto store = [&table](std::size_t at, const ModeStep& step) {
    StoreModeStep(at, step, table);
  };
  // Both planes carry the same numbers, so that one loop runs over all modes.
  for (std::size_t i = 0; i < modes; ++i) {
    const ModeStep step =
        MakeModeStep(now_.frequency_rad_per_s[i], now_.damping_ratio[i], table.duration_s);
    store(i, step);
    store(modes + i, guided() ? MakeModeStep(2.0 * std::numbers::pi * kGuideFrequencyHz,
                                             kGuideDamping, table.duration_s)
                              : step);
  }
  for (std::size_t i = 0; i < layout_.twists; ++i) {
    const auto mode = static_cast<Eigen::Index>(i);
    store(2 * modes + i, MakeModeStep(parameters_.torsion.frequency_rad_per_s[mode],
                                      parameters_.torsion.damping_ratio[mode], table.duration_s));
  }
  MakeAxisSteps(now_, effects_, table);
  MakeEddySteps(effects_, table);
  for (std::size_t b = 0; b < table.housing.size(); ++b) {
    const BearingEffects& bearing = effects_.bearings[b];
    table.housing[b] =
        MakeModeStep(bearing.housing_rad_per_s, bearing.housing_damping_ratio, table.duration_s);
  }
}

}  // namespace levitas::plant
