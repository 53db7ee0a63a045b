// Effects of timing, magnets and sensors.
#include <cmath>
#include <complex>
#include <variant>

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/effect/coil.hpp"
#include "plant_sim/effect/placed_id.hpp"
#include "plant_sim/effect/reading.hpp"
#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/plant/applied_effects/apply_effects.hpp"
#include "plant_sim/plant/magnet_of.hpp"

namespace levitas::plant {
namespace {

using effect::AmplifierId;
using effect::EffectConfig;
using effect::Id;
using effect::MagnetId;
using effect::SensorId;
using effect::TimingId;

void ApplyToAxis(AmplifierId id, const Values& values, MagnetEffects& magnet) noexcept {
  switch (id) {
    case AmplifierId::kCurrentGain:
      magnet.gain *= values[0];
      break;
    case AmplifierId::kCommandOffset:
      magnet.command_offset_a += values[0];
      break;
    case AmplifierId::kAmplifierBandwidth:
    case AmplifierId::kAmplifierSlew:
      break;  // how currents follow: ApplyToAmplifiers()
  }
}

void ApplyToAxis(const BearingConfig& bearing, MagnetId id, const Values& values,
                 MagnetEffects& magnet) noexcept {
  switch (id) {
    case MagnetId::kForceConstant:
      magnet.towards *= std::sqrt(values[0]);  // the force goes with the square of the current
      magnet.away *= std::sqrt(values[0]);
      break;
    case MagnetId::kDisplacementStiffness:
      magnet.stiffness_n_per_m +=
          (values[0] - 1.0) *
          magnet::NegativeStiffness(MagnetOf(bearing.magnet), bearing.magnet.bias_current_a);
      break;
    case MagnetId::kCoilAsymmetry: {
      const auto factors = effect::Asymmetry(values[0]);
      magnet.towards *= factors.towards;
      magnet.away *= factors.away;
      break;
    }
    case MagnetId::kMagneticSaturation:
      magnet.per_knee_1_per_a = 1.0 / values[0];
      magnet.knee_exponent = values[1];
      break;
    case MagnetId::kHysteresis:
      magnet.hysteresis_width_a = values[0];
      magnet.hysteresis_shape = values[1];
      break;
    case MagnetId::kEddyCurrent:
      magnet.eddy_tau_s = values[0];
      magnet.eddy_a_per_m =
          values[1] *
          magnet::NegativeStiffness(MagnetOf(bearing.magnet), bearing.magnet.bias_current_a) /
          magnet::ForcePerCurrent(MagnetOf(bearing.magnet), bearing.magnet.bias_current_a);
      break;
    case MagnetId::kMagneticCoupling:
    case MagnetId::kAxisRotation:
      break;  // of a bearing: ApplyToMagnets()
  }
}

void ApplyToReading(SensorId id, const Values& values, double period_s,
                    ReadingEffects& reading) noexcept {
  switch (id) {
    case SensorId::kSensorGain:
      reading.gain *= values[0];
      break;
    case SensorId::kSensorOffset:
      reading.offset_m += values[0];
      break;
    case SensorId::kSensorNonlinearity:
      reading.a2_1_per_m += values[0];
      reading.a3_1_per_m2 += values[1];
      break;
    case SensorId::kSensorBandwidth:
      reading.bandwidth_hz = values[0];
      break;
    case SensorId::kSensorNoise:
      reading.noise_rms_m = values[0];
      reading.noise_memory = effect::NoiseMemory(values[1], period_s);
      break;
    case SensorId::kSensorPosition:  // ApplyEffects()
    case SensorId::kSensorRunout:    // ApplyToSensors()
    case SensorId::kMainsPickup:
      break;
  }
}

}  // namespace

void ApplyToLoop(const EffectConfig& entry, const Values& values, double period_s, RigNow& now,
                 EffectModel& model) noexcept {
  switch (std::get<TimingId>(effect::Placed(entry.id))) {
    case TimingId::kExtraDelay:
      now.delay_samples += values[0] / period_s;
      break;
    case TimingId::kDroppedSamples:
      model.drop_probability = values[0];
      model.drop_burst = static_cast<int>(values[1]);
      break;
    case TimingId::kSampleJitter:
      model.jitter_s = values[0];
      break;
  }
}

void ApplyToMagnets(const PlantParameters& parameters, const EffectConfig& entry,
                    const Values& values, EffectModel& model) noexcept {
  if (entry.id == Id::kAxisRotation) {
    if (entry.on_sensor) {
      model.turns[entry.bearing] = {std::cos(values[0]), std::sin(values[0])};
    } else {
      model.bearings[entry.bearing].cosine = std::cos(values[0]);
      model.bearings[entry.bearing].sine = std::sin(values[0]);
    }
    return;
  }
  if (entry.id == Id::kMagneticCoupling) {
    model.bearings[entry.bearing].coupling += values[0];
    return;
  }
  const auto& bearings = parameters.config.bearings;
  const effect::PlacedId placed = effect::Placed(entry.id);
  const auto* of_amplifier = std::get_if<AmplifierId>(&placed);
  for (std::size_t axis = 0; axis < 2 * bearings.size(); ++axis) {
    if (!entry.Acts(axis)) continue;
    MagnetEffects& magnet = model.bearings[axis / 2].axis[axis % 2];
    if (of_amplifier != nullptr) {
      ApplyToAxis(*of_amplifier, values, magnet);
    } else {
      ApplyToAxis(bearings[axis / 2], std::get<MagnetId>(placed), values, magnet);
    }
  }
}

void ApplyToSensors(const PlantParameters& parameters, const EffectConfig& entry, double strength,
                    EffectModel& model, Slots& slots) noexcept {
  const auto& config = parameters.config;
  const double period_s = static_cast<double>(config.period_ns) * 1e-9;
  const auto id = std::get<SensorId>(effect::Placed(entry.id));
  for (std::size_t axis = 0; axis < 2 * config.bearings.size(); ++axis) {
    if (!entry.Acts(axis)) continue;
    const Values values = ValuesAt(parameters, entry, axis, strength);
    if (id == SensorId::kSensorRunout) {
      const int order = static_cast<int>(values[0]);
      model.runouts[slots.runout++] = {
          axis, order, effect::RunoutAmplitude(values[1], values[2], order, axis % 2 == 1)};
    } else if (id == SensorId::kMainsPickup) {
      model.pickups[slots.pickup++] = {axis, values[0], values[1], values[2]};
    } else {
      ApplyToReading(id, values, period_s, model.readings[axis]);
    }
  }
}

}  // namespace levitas::plant
