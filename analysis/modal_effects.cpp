#include "analysis/modal_effects.hpp"

#include <vector>

namespace levitas::analysis {

ModalInfluence InfluenceOf(effect::Id id) noexcept {
  using effect::Id;
  switch (id) {
    case Id::kModalFrequency:
    case Id::kModalDamping:
    case Id::kGyroscopicInertia:
    case Id::kRotorMass:
    case Id::kInternalDamping:
    case Id::kCouplingStiffness:
    case Id::kCrossCoupledStiffness:
      return ModalInfluence::kOnTheRotor;
    case Id::kShaftAnisotropy:
    case Id::kBreathingCrack:
      return ModalInfluence::kTurning;
    case Id::kSupportMode:
    case Id::kCurrentGain:
    case Id::kDisplacementStiffness:
    case Id::kCoilAsymmetry:
    case Id::kMagneticSaturation:
    case Id::kHysteresis:
    case Id::kEddyCurrent:
    case Id::kAxisRotation:
    case Id::kExtraDelay:
    case Id::kAmplifierBandwidth:
    case Id::kSensorGain:
    case Id::kSensorBandwidth:
    case Id::kSensorPosition:
      return ModalInfluence::kOnTheLoop;
    default:
      return ModalInfluence::kNone;
  }
}

plant::PlantConfig WithModalEffects(const plant::PlantConfig& plant) {
  plant::PlantConfig with = plant;
  std::erase_if(with.effects, [](const effect::EffectConfig& entry) {
    return InfluenceOf(entry.id) != ModalInfluence::kOnTheRotor;
  });
  for (effect::EffectConfig& entry : with.effects) entry.at_s = entry.ramp_s = 0.0;
  return with;
}

}  // namespace levitas::analysis
