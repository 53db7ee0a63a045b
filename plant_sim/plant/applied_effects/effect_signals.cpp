#include "plant_sim/plant/applied_effects/effect_signals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant_sim/effect/eddy_current.hpp"
#include "plant_sim/effect/hysteresis.hpp"
#include "plant_sim/effect/reading.hpp"

namespace levitas::plant {
namespace {

bool HasLag(const MagnetEffects& magnet) noexcept {
  return magnet.eddy_state != kNoState && magnet.eddy_tau_s > 0.0;
}

// Current and displacement make flux as one, ic + (ks/ki) x, and lag as one; the force law adds the
// displacement without a lag, so its share is taken off again.
double Lagged(const MagnetEffects& magnet, double control_a, double displacement_m,
              const double* state) noexcept {
  if (!HasLag(magnet)) return control_a;
  const double displacement_a = magnet.eddy_a_per_m * displacement_m;
  return effect::EddyOutput(control_a + displacement_a, state + magnet.eddy_state) - displacement_a;
}

bool HasLoop(const MagnetEffects& magnet) noexcept {
  return magnet.hysteresis_state != kNoState && magnet.hysteresis_width_a > 0.0;
}

}  // namespace

AxisArray SeenByMagnets(const EffectModel& effects, const AxisArray& position_m) noexcept {
  AxisArray seen_m = position_m;
  for (std::size_t b = 0; b < effects.bearings.size(); ++b) {
    const double c = effects.bearings[b].cosine;
    const double s = effects.bearings[b].sine;
    seen_m[2 * b] = c * position_m[2 * b] + s * position_m[2 * b + 1];
    seen_m[2 * b + 1] = c * position_m[2 * b + 1] - s * position_m[2 * b];
  }
  return seen_m;
}

AxisArray Magnetising(const EffectModel& effects, const MagnetInput& input,
                      const double* state) noexcept {
  AxisArray flux_a = input.control_a;
  for (std::size_t axis = 0; axis < 2 * effects.bearings.size(); ++axis) {
    const MagnetEffects& magnet = effects.bearings[axis / 2].axis[axis % 2];
    flux_a[axis] = Lagged(magnet, input.control_a[axis], input.displacement_m[axis], state);
    if (HasLoop(magnet)) {
      flux_a[axis] -= magnet.hysteresis_width_a * state[magnet.hysteresis_state];
    }
  }
  return flux_a;
}

void AdvanceMemory(const EffectModel& effects, const StepTable& table, const MagnetInput& before,
                   const MagnetInput& after, double* state) noexcept {
  for (std::size_t axis = 0; axis < 2 * effects.bearings.size(); ++axis) {
    const MagnetEffects& magnet = effects.bearings[axis / 2].axis[axis % 2];
    const double lagged_before_a =
        Lagged(magnet, before.control_a[axis], before.displacement_m[axis], state);
    if (magnet.eddy_state != kNoState) {
      const double per_m = magnet.eddy_a_per_m;
      const double before_a = before.control_a[axis] + per_m * before.displacement_m[axis];
      const double after_a = after.control_a[axis] + per_m * after.displacement_m[axis];
      const sensor::FilterStep* lag = table.eddy.data() + axis * effect::kEddyLags;
      for (std::size_t k = 0; k < effect::kEddyLags; ++k) {
        double& value = state[magnet.eddy_state + k];
        value = lag[k].decay * value + lag[k].start * before_a + lag[k].end * after_a;
      }
    }
    if (HasLoop(magnet)) {
      double& z = state[magnet.hysteresis_state];
      z = effect::HysteresisStep(
          magnet.hysteresis_width_a, magnet.hysteresis_shape, z, lagged_before_a,
          Lagged(magnet, after.control_a[axis], after.displacement_m[axis], state));
    }
  }
}

void SettleMemory(const EffectModel& effects, const MagnetInput& input, double* state) noexcept {
  for (std::size_t axis = 0; axis < 2 * effects.bearings.size(); ++axis) {
    const MagnetEffects& magnet = effects.bearings[axis / 2].axis[axis % 2];
    if (magnet.eddy_state == kNoState) continue;
    std::fill_n(state + magnet.eddy_state, effect::kEddyLags,
                input.control_a[axis] + magnet.eddy_a_per_m * input.displacement_m[axis]);
  }
}

void View(const PlantModel& model, double cosine, double sine, const double* state,
          AxisArray& seen_m) noexcept {
  const EffectModel& effects = model.effects();
  for (std::size_t b = 0; b < effects.bearings.size(); ++b) {
    double& x_m = seen_m[2 * b];
    double& y_m = seen_m[2 * b + 1];
    if (effects.bearings[b].housing_state != kNoState) {
      x_m -= state[effects.bearings[b].housing_state];
      y_m -= state[effects.bearings[b].housing_state + 1];
    }
    const auto [c, s] = effects.turns[b];
    const double turned_m = c * x_m + s * y_m;
    y_m = c * y_m - s * x_m;
    x_m = turned_m;
  }
  for (const SensorRunout& runout : effects.runouts) {
    const auto turned = effect::Turned(cosine, sine, runout.order);
    seen_m[runout.axis] += (runout.amplitude_m * turned).real();
  }
  for (std::size_t axis = 0; axis < model.axes(); ++axis) {
    const ReadingEffects& reading = effects.readings[axis];
    seen_m[axis] = effect::Characteristic(seen_m[axis], reading.a2_1_per_m, reading.a3_1_per_m2);
  }
}

void AddOutputs(const EffectModel& effects, std::size_t axes, double time_s,
                AxisArray& output_m) noexcept {
  for (std::size_t axis = 0; axis < axes; ++axis) output_m[axis] += effects.readings[axis].offset_m;
  for (const Pickup& pickup : effects.pickups) {
    output_m[pickup.axis] +=
        pickup.amplitude_m *
        std::cos(2.0 * std::numbers::pi * pickup.frequency_hz * time_s + pickup.phase_rad);
  }
}

}  // namespace levitas::plant
