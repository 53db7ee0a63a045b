#include "diagnosis/levitator/origin.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "common/problem.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/plant/plain_sensors.hpp"

namespace levitas::levitator {
namespace {

using effect::Id;

bool IsRatio(std::size_t i) {
  constexpr std::array kRatios{kSupply,         kResistance, kInductance, kAwaySupply,
                               kAwayInductance, kProbeGain,  kForce,      kForceDecay,
                               kForceAway,      kSensorGain, kMass};
  return std::find(kRatios.begin(), kRatios.end(), i) != kRatios.end();
}

double LagOf(double bandwidth_hz) { return 1.0 / (2.0 * std::numbers::pi * bandwidth_hz); }

[[noreturn]] void RefuseEffect(const effect::EffectConfig& entry,
                               const configuration::RigFile& file) {
  throw BadInput(
      fmt::format("rig {}: effects: `{}` has no place in the diagnosis of a ball between two "
                  "magnets; write it into the keys of the coil or the magnet, or leave it out",
                  file.numbers.name, effect::At(entry.id).name));
}

Theta Of(const effect::EffectConfig& entry, const configuration::RigFile& file) {
  const auto& v = entry.values;
  Theta t = Zeros(0);
  switch (entry.id) {
    case Id::kExtraDelay:
      t[kDelay] = v[0] / (static_cast<double>(file.plant.period_ns) * 1e-9);
      break;
    case Id::kMagneticSaturation:
      t[kForceKnee] = 1.0 / (v[0] * v[0]);  // exponent 2, which ExtendedRig writes
      break;
    case Id::kEddyCurrent:
      t[kForceLag] = v[0];
      break;
    case Id::kSensorGain:
      t[kSensorGain] = v[0] - 1.0;
      break;
    case Id::kSensorOffset:
      t[kSensorOffset] = v[0];
      break;
    case Id::kSensorNonlinearity:
      t[kSensorSquare] = v[0];
      t[kSensorCube] = v[1];
      break;
    case Id::kSensorBandwidth:
      t[kSensorLag] = LagOf(v[0]) - LagOf(file.plant.bearings.at(0).sensor.bandwidth_hz);
      break;
    case Id::kRotorMass:
      t[kMass] = v[0] - 1.0;
      break;
    case Id::kStaticLoad:
      t[kLoad] = v[1];
      break;
    case Id::kCouplingStiffness:
      t[kSpring] = v[1];
      break;
    case Id::kSensorNoise:
      break;  // nothing that moves
    default:
      RefuseEffect(entry, file);
  }
  return t;
}

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
    all = ComposedWith(all, Of(entry, file));
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
