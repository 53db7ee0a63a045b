#include "plant_sim/plant/applied_effects/apply_effects.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "plant_sim/effect/parameter_kinds.hpp"
#include "plant_sim/effect/placed_id.hpp"
#include "plant_sim/effect/strength.hpp"
#include "plant_sim/plant/coils_of.hpp"

namespace levitas::plant {
namespace {

using effect::EffectConfig;
using effect::Id;

// Of the current loop; of a coil on a voltage that of the coil towards +x, the rotor centred and
// the coil settled at the bias.
double CoilBandwidth(const BearingConfig& b) noexcept {
  if (!b.amplifier.voltage) return b.amplifier.bandwidth_hz;
  const amplifier::VoltageCoil coil = CoilsOf(b)[0];
  const double settled_a =
      coil.steady * amplifier::Driven(coil, b.magnet.bias_current_a) + coil.offset_a;
  const double iron = 1.0 + coil.iron_1_per_a2 * settled_a * settled_a;
  return std::exp(b.magnet.gap_m / coil.decay_m) / (effect::kTurn * coil.time_constant_s) * iron;
}

// Every number that entries change, back to the rig's own.
void Reset(const PlantParameters& parameters, RigNow& now, EffectModel& model) noexcept {
  const PlantConfig& config = parameters.config;
  now.delay_samples = config.delay_samples;
  for (std::size_t i = 0; i < now.frequency_rad_per_s.size(); ++i) {
    const auto mode = static_cast<Eigen::Index>(i);
    now.frequency_rad_per_s[i] = parameters.modes.frequency_rad_per_s[mode];
    now.damping_ratio[i] = parameters.modes.damping_ratio[mode];
  }
  now.gyroscopic_ratio = now.mass_ratio = 1.0;
  now.sensor_shift_share = {};
  std::fill(now.unbalance.begin(), now.unbalance.end(), 0.0);
  std::fill(now.static_load.begin(), now.static_load.end(), 0.0);
  for (std::size_t axis = 0; axis < 2 * config.bearings.size(); ++axis) {
    const BearingConfig& b = config.bearings[axis / 2];
    now.amplifier_bandwidth_hz[axis] = CoilBandwidth(b);
    now.slew_a_per_s[axis] = b.amplifier.slew_a_per_s;
    ReadingEffects& reading = model.readings[axis];
    reading = {};
    reading.gain = b.sensor.gain;
    reading.bandwidth_hz = b.sensor.bandwidth_hz;
    reading.noise_rms_m = b.sensor.noise_rms_m;
  }
  for (BearingEffects& bearing : model.bearings) {
    bearing.cosine = 1.0;
    bearing.sine = 0.0;
    for (MagnetEffects& magnet : bearing.axis) {
      const std::size_t hysteresis = magnet.hysteresis_state;
      const std::size_t eddy = magnet.eddy_state;
      magnet = {};
      magnet.hysteresis_state = hysteresis;
      magnet.eddy_state = eddy;
    }
  }
  std::fill(model.turns.begin(), model.turns.end(), SensorTurn{});
  std::fill(model.bow.begin(), model.bow.end(), 0.0);
  model.anisotropy = 0.0;
  model.drop_probability = 0.0;
  model.jitter_s = 0.0;
}

// Own values depend on the axis only for effects of channels, which apply them per axis below.
std::size_t FirstAxis(const EffectConfig& entry) noexcept {
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    if (entry.Acts(axis)) return axis;
  }
  return 0;
}

constexpr Eigen::Index kNoMode = -1;

/// The first parameter's value that the rig has without the effect; NaN where it has none. No
/// default where a rig has some: the compiler names a new effect there.
struct OwnValue {
  const BearingConfig& bearing;
  const rotor::ModalRotor& modes;
  Eigen::Index mode{kNoMode};

  // These count from 0, 1 or infinity; those of gears, see OwnValues().
  double operator()(effect::TimingId /*id*/) const noexcept { return effect::kOwn; }
  double operator()(effect::MagnetId /*id*/) const noexcept { return effect::kOwn; }
  double operator()(effect::SupportId /*id*/) const noexcept { return effect::kOwn; }
  double operator()(effect::ExternalId /*id*/) const noexcept { return effect::kOwn; }
  double operator()(effect::GearId /*id*/) const noexcept { return effect::kOwn; }
  double operator()(effect::CoilId /*id*/) const noexcept { return effect::kOwn; }
  double operator()(effect::BallId /*id*/) const noexcept { return effect::kOwn; }

  double operator()(effect::AmplifierId id) const noexcept {
    using effect::AmplifierId;
    switch (id) {
      case AmplifierId::kAmplifierBandwidth:
        return bearing.amplifier.bandwidth_hz;
      case AmplifierId::kAmplifierSlew:
      case AmplifierId::kCurrentGain:
      case AmplifierId::kCommandOffset:
        break;
    }
    return effect::kOwn;
  }

  double operator()(effect::SensorId id) const noexcept {
    using effect::SensorId;
    switch (id) {
      case SensorId::kSensorBandwidth:
        return bearing.sensor.bandwidth_hz;
      case SensorId::kSensorNoise:
        return bearing.sensor.noise_rms_m;
      case SensorId::kSensorGain:
      case SensorId::kSensorOffset:
      case SensorId::kSensorNonlinearity:
      case SensorId::kSensorPosition:
      case SensorId::kSensorRunout:
      case SensorId::kMainsPickup:
        break;
    }
    return effect::kOwn;
  }

  double operator()(effect::RotorId id) const noexcept {
    using effect::RotorId;
    switch (id) {
      case RotorId::kModalFrequency:
        return mode == kNoMode ? effect::kOwn : modes.frequency_rad_per_s[mode] / effect::kTurn;
      case RotorId::kModalDamping:
        return mode == kNoMode ? effect::kOwn : modes.damping_ratio[mode];
      case RotorId::kUnbalance:
      case RotorId::kShaftBow:
      case RotorId::kShaftAnisotropy:
      case RotorId::kGyroscopicInertia:
      case RotorId::kInternalDamping:
      case RotorId::kRotorMass:
      case RotorId::kBreathingCrack:
        break;
    }
    return effect::kOwn;
  }
};

}  // namespace

Values ValuesAt(const PlantParameters& parameters, const EffectConfig& entry, std::size_t axis,
                double strength) noexcept {
  const auto table = effect::At(entry.id).parameters;
  const Values own = OwnValues(parameters, entry, axis);
  Values values{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    values[i] = effect::AtStrength(table[i], entry.values[i], own[i], strength);
  }
  return values;
}

Values OwnValues(const PlantParameters& parameters, const EffectConfig& entry,
                 std::size_t axis) noexcept {
  Values own;
  own.fill(effect::kOwn);
  if (effect::At(entry.id).scope == effect::Scope::kGear) {
    if (entry.id != Id::kMeshStiffness) return own;
    own[0] = parameters.config.gears[entry.gear].stiffness_n_per_m;
    own[1] = parameters.config.gears[entry.gear].damping_n_s_per_m;
    return own;
  }
  if (parameters.config.bearings.empty()) return own;
  const std::size_t bearing = std::min(axis / 2, parameters.config.bearings.size() - 1);
  const BearingConfig& b = parameters.config.bearings[bearing];
  const auto mode = static_cast<Eigen::Index>(FlexibleMode(parameters, entry));
  const bool has_mode = mode < parameters.modes.frequency_rad_per_s.size();
  own[0] = std::visit(OwnValue{b, parameters.modes, has_mode ? mode : kNoMode},
                      effect::Placed(entry.id));
  return own;
}

namespace {

/// How the coil currents follow their commands; other effects of amplifiers are scales and offsets.
void ApplyToAmplifiers(const PlantParameters& parameters, const EffectConfig& entry,
                       double strength, RigNow& now) noexcept {
  for (std::size_t axis = 0; axis < 2 * parameters.config.bearings.size(); ++axis) {
    if (!entry.Acts(axis)) continue;
    const double value = ValuesAt(parameters, entry, axis, strength)[0];
    if (entry.id == Id::kAmplifierBandwidth) now.amplifier_bandwidth_hz[axis] = value;
    if (entry.id == Id::kAmplifierSlew && std::isfinite(value)) {
      double& slew = now.slew_a_per_s[axis];
      slew = slew > 0.0 ? std::min(slew, value) : value;
    }
  }
}

void ApplyRotorMass(const PlantParameters& parameters, std::span<const double> strengths,
                    RigNow& now) noexcept {
  const auto& entries = parameters.config.effects;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].id != Id::kRotorMass) continue;
    now.mass_ratio *= ValuesAt(parameters, entries[i], 0, strengths[i])[0];
  }
}

/// The shaft is straightened by its own stiffness.
void StraightenBow(const RigNow& now, EffectModel& model) noexcept {
  const std::size_t modes = now.frequency_rad_per_s.size();
  for (std::size_t i = 0; i < model.bow.size(); ++i) {
    const double w = now.frequency_rad_per_s[i % modes];
    model.bow[i] *= w * w;
  }
}

}  // namespace

RigNow PrepareRig(const PlantParameters& parameters) {
  RigNow now;
  const auto modes = static_cast<std::size_t>(parameters.modes.frequency_rad_per_s.size());
  now.rigid_modes = static_cast<std::size_t>(parameters.modes.rigid_modes);
  now.frequency_rad_per_s.resize(modes);
  now.damping_ratio.resize(modes);
  now.unbalance.resize(2 * modes);
  now.static_load.resize(2 * modes);
  return now;
}

void ApplyEffects(const PlantParameters& parameters, const EntryShapes& shapes,
                  std::span<const double> strengths, RigNow& now, EffectModel& model) noexcept {
  Reset(parameters, now, model);
  const auto& entries = parameters.config.effects;
  const double period_s = static_cast<double>(parameters.config.period_ns) * 1e-9;
  // First, because the shapes of all other entries depend on it.
  ApplyRotorMass(parameters, strengths, now);
  Slots slots;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const EffectConfig& entry = entries[i];
    const double strength = strengths[i];
    const Values values = ValuesAt(parameters, entry, FirstAxis(entry), strength);
    switch (effect::At(entry.id).place) {
      case effect::Place::kTiming:
        ApplyToLoop(entry, values, period_s, now, model);
        break;
      case effect::Place::kAmplifier:
        ApplyToAmplifiers(parameters, entry, strength, now);
        ApplyToMagnets(parameters, entry, values, model);
        break;
      case effect::Place::kMagnet:
        ApplyToMagnets(parameters, entry, values, model);
        break;
      case effect::Place::kSensor:
        if (entry.id == Id::kSensorPosition) now.sensor_shift_share[entry.bearing] = strength;
        ApplyToSensors(parameters, entry, strength, model, slots);
        break;
      case effect::Place::kRotor:
        ApplyToRotor(parameters, entry, values, shapes[i], now, model, slots);
        break;
      case effect::Place::kExternal:
      case effect::Place::kSupport:
        ApplyFromOutside(entry, values, shapes[i], now, model, slots);
        break;
      case effect::Place::kGear:
      case effect::Place::kCoil:  // no entries: CheckEffects refuses them
      case effect::Place::kBall:
        break;
    }
  }
  StraightenBow(now, model);
}

}  // namespace levitas::plant
