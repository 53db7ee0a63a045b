#include "diagnosis/levitator/origin.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <variant>

#include "common/problem.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/effect/placed_id.hpp"
#include "plant_sim/plant/plain_sensors.hpp"

namespace levitas::levitator {
namespace {

bool IsRatio(std::size_t i) {
  constexpr std::array kRatios{kSupply,         kResistance, kInductance, kAwaySupply,
                               kAwayInductance, kProbeGain,  kForce,      kForceDecay,
                               kForceAway,      kSensorGain, kMass};
  return std::find(kRatios.begin(), kRatios.end(), i) != kRatios.end();
}

double LagOf(double bandwidth_hz) { return 1.0 / (2.0 * std::numbers::pi * bandwidth_hz); }

/// What an effect of the rig file moves. Only some have a parameter here; no default where they
/// do, so that the compiler names a new effect there.
struct MovedBy {
  const effect::EffectConfig& entry;
  const configuration::RigFile& file;

  Theta operator()(effect::TimingId id) const {
    using effect::TimingId;
    switch (id) {
      case TimingId::kExtraDelay:
        return One(kDelay, v(0) / (static_cast<double>(file.plant.period_ns) * 1e-9));
      case TimingId::kDroppedSamples:
      case TimingId::kSampleJitter:
        break;
    }
    Refuse();
  }

  Theta operator()(effect::MagnetId id) const {
    using effect::MagnetId;
    switch (id) {
      case MagnetId::kMagneticSaturation:
        return One(kForceKnee, 1.0 / (v(0) * v(0)));  // exponent 2, which ExtendedRig writes
      case MagnetId::kEddyCurrent:
        return One(kForceLag, v(0));
      case MagnetId::kForceConstant:
      case MagnetId::kDisplacementStiffness:
      case MagnetId::kCoilAsymmetry:
      case MagnetId::kHysteresis:
      case MagnetId::kMagneticCoupling:
      case MagnetId::kAxisRotation:
        break;
    }
    Refuse();
  }

  Theta operator()(effect::SensorId id) const {
    using effect::SensorId;
    switch (id) {
      case SensorId::kSensorGain:
        return One(kSensorGain, v(0) - 1.0);
      case SensorId::kSensorOffset:
        return One(kSensorOffset, v(0));
      case SensorId::kSensorNonlinearity: {
        Theta t = One(kSensorSquare, v(0));
        t[kSensorCube] = v(1);
        return t;
      }
      case SensorId::kSensorBandwidth:
        return One(kSensorLag, LagOf(v(0)) - LagOf(file.plant.bearings.at(0).sensor.bandwidth_hz));
      case SensorId::kSensorNoise:
        return Zeros(0);  // nothing that moves
      case SensorId::kSensorPosition:
      case SensorId::kSensorRunout:
      case SensorId::kMainsPickup:
        break;
    }
    Refuse();
  }

  Theta operator()(effect::RotorId id) const {
    using effect::RotorId;
    switch (id) {
      case RotorId::kRotorMass:
        return One(kMass, v(0) - 1.0);
      case RotorId::kUnbalance:
      case RotorId::kShaftBow:
      case RotorId::kShaftAnisotropy:
      case RotorId::kModalFrequency:
      case RotorId::kModalDamping:
      case RotorId::kGyroscopicInertia:
      case RotorId::kInternalDamping:
      case RotorId::kBreathingCrack:
        break;
    }
    Refuse();
  }

  Theta operator()(effect::ExternalId id) const {
    using effect::ExternalId;
    switch (id) {
      case ExternalId::kStaticLoad:
        return One(kLoad, v(1));
      case ExternalId::kCouplingStiffness:
        return One(kSpring, v(1));
      case ExternalId::kMisalignment:
      case ExternalId::kCrossCoupledStiffness:
        break;
    }
    Refuse();
  }

  Theta operator()(effect::AmplifierId id) const {
    using effect::AmplifierId;
    switch (id) {
      case AmplifierId::kCommandOffset:
        return One(kCommandUpper, v(0));
      case AmplifierId::kCurrentGain:
      case AmplifierId::kAmplifierBandwidth:
      case AmplifierId::kAmplifierSlew:
        break;  // keys of the coil stand for them
    }
    Refuse();
  }

  // A ball has neither housings nor wheels.
  Theta operator()(effect::SupportId /*id*/) const { Refuse(); }
  Theta operator()(effect::GearId /*id*/) const { Refuse(); }
  // No entries of a rig file.
  Theta operator()(effect::CoilId /*id*/) const { Refuse(); }
  Theta operator()(effect::BallId /*id*/) const { Refuse(); }

  [[nodiscard]] double v(std::size_t i) const { return entry.values[i]; }

  [[nodiscard]] static Theta One(Parameter parameter, double value) {
    Theta t = Zeros(0);
    t[parameter] = value;
    return t;
  }

  [[noreturn]] void Refuse() const {
    throw BadInput(
        fmt::format("rig {}: effects: `{}` has no place in the diagnosis of a ball between two "
                    "magnets; write it into the keys of the coil or the magnet, or leave it out",
                    file.numbers.name, effect::At(entry.id).name));
  }
};

}  // namespace

Theta EffectsOf(const configuration::RigFile& file) {
  if (!plant::HasPlainSensors(file.plant)) {
    throw BadInput(
        fmt::format("rig {}: a diagnosis {}", file.numbers.name, plant::kPlainSensorsOnly));
  }
  Theta all = Zeros(0);
  for (const effect::EffectConfig& entry : file.plant.effects) {
    if (entry.timed() || entry.strength != 1.0) {
      throw BadInput(fmt::format(
          "rig {}: effects: `{}` sets in at {} s with strength {}; a diagnosis takes what is there "
          "from the beginning with strength 1",
          file.numbers.name, effect::At(entry.id).name, entry.at_s, entry.strength));
    }
    all = ComposedWith(all, std::visit(MovedBy{entry, file}, effect::Placed(entry.id)));
  }
  return all;
}

Theta OriginOf(const configuration::RigFile& file) {
  Theta t = EffectsOf(file);
  if (const auto& coil = file.plant.bearings.at(0).amplifier.voltage) {
    t[kDeadBand] = coil->dead_band_a;
    t[kDriveCurve] = coil->curvature;
    t[kIronInductance] = coil->iron_1_per_a2;
    t[kHeating] = coil->warming_1_per_s;
    t[kAwaySupply] = coil->away_steady_ratio - 1.0;
    t[kAwayInductance] = coil->away_time_constant_ratio - 1.0;
  }
  return t;
}

double ComposedWith(std::size_t parameter, double origin, double theta) {
  return IsRatio(parameter) ? (1.0 + origin) * (1.0 + theta) - 1.0 : origin + theta;
}

double LowerBound(std::size_t parameter, double origin) {
  const double least = Table()[parameter].least;
  return IsRatio(parameter) ? least : least - origin;
}

Theta ComposedWith(const Theta& origin, Theta theta) {
  for (std::size_t i = 0; i < kParameters; ++i) theta[i] = ComposedWith(i, origin[i], theta[i]);
  return theta;
}

}  // namespace levitas::levitator
