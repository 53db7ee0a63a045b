#pragma once
// The ids by place, each place with an enum of its own.
//
// Use        Who treats effects place by place visits Placed(id), or switches over the enum of one
//            place, without a default: the compiler then names what a new effect lacks.
// New effect Placed() does not compile before the id has its place here; then the switches over
//            that place's enum name the rest. The rows of the catalogue are checked against it.
// Thread     any; constant data. Failure: Placed() of no id is a programming error
//            (std::logic_error).

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <variant>

#include "plant_sim/effect/effect_config.hpp"

namespace levitas::effect {

using IdNumber = std::underlying_type_t<Id>;
[[nodiscard]] constexpr IdNumber NumberOf(Id id) noexcept { return static_cast<IdNumber>(id); }

enum class TimingId : IdNumber {
  kExtraDelay = NumberOf(Id::kExtraDelay),
  kDroppedSamples = NumberOf(Id::kDroppedSamples),
  kSampleJitter = NumberOf(Id::kSampleJitter),
};
enum class AmplifierId : IdNumber {
  kAmplifierBandwidth = NumberOf(Id::kAmplifierBandwidth),
  kAmplifierSlew = NumberOf(Id::kAmplifierSlew),
  kCurrentGain = NumberOf(Id::kCurrentGain),
  kCommandOffset = NumberOf(Id::kCommandOffset),
};
enum class MagnetId : IdNumber {
  kForceConstant = NumberOf(Id::kForceConstant),
  kDisplacementStiffness = NumberOf(Id::kDisplacementStiffness),
  kCoilAsymmetry = NumberOf(Id::kCoilAsymmetry),
  kMagneticSaturation = NumberOf(Id::kMagneticSaturation),
  kHysteresis = NumberOf(Id::kHysteresis),
  kEddyCurrent = NumberOf(Id::kEddyCurrent),
  kMagneticCoupling = NumberOf(Id::kMagneticCoupling),
  kAxisRotation = NumberOf(Id::kAxisRotation),
};
enum class RotorId : IdNumber {
  kUnbalance = NumberOf(Id::kUnbalance),
  kShaftBow = NumberOf(Id::kShaftBow),
  kShaftAnisotropy = NumberOf(Id::kShaftAnisotropy),
  kModalFrequency = NumberOf(Id::kModalFrequency),
  kModalDamping = NumberOf(Id::kModalDamping),
  kGyroscopicInertia = NumberOf(Id::kGyroscopicInertia),
  kInternalDamping = NumberOf(Id::kInternalDamping),
  kRotorMass = NumberOf(Id::kRotorMass),
  kBreathingCrack = NumberOf(Id::kBreathingCrack),
};
enum class SupportId : IdNumber {
  kSupportMode = NumberOf(Id::kSupportMode),
  kTouchdownRub = NumberOf(Id::kTouchdownRub),
};
enum class ExternalId : IdNumber {
  kMisalignment = NumberOf(Id::kMisalignment),
  kCouplingStiffness = NumberOf(Id::kCouplingStiffness),
  kCrossCoupledStiffness = NumberOf(Id::kCrossCoupledStiffness),
  kStaticLoad = NumberOf(Id::kStaticLoad),
};
enum class GearId : IdNumber {
  kMeshStiffness = NumberOf(Id::kMeshStiffness),
  kMeshStiffnessVariation = NumberOf(Id::kMeshStiffnessVariation),
  kBacklash = NumberOf(Id::kBacklash),
  kMeshFriction = NumberOf(Id::kMeshFriction),
  kTransmissionError = NumberOf(Id::kTransmissionError),
  kGearRunout = NumberOf(Id::kGearRunout),
  kToothCrack = NumberOf(Id::kToothCrack),
};
enum class SensorId : IdNumber {
  kSensorGain = NumberOf(Id::kSensorGain),
  kSensorOffset = NumberOf(Id::kSensorOffset),
  kSensorNonlinearity = NumberOf(Id::kSensorNonlinearity),
  kSensorBandwidth = NumberOf(Id::kSensorBandwidth),
  kSensorPosition = NumberOf(Id::kSensorPosition),
  kSensorRunout = NumberOf(Id::kSensorRunout),
  kMainsPickup = NumberOf(Id::kMainsPickup),
  kSensorNoise = NumberOf(Id::kSensorNoise),
};

/// In the order of Place.
using PlacedId =
    std::variant<TimingId, AmplifierId, MagnetId, RotorId, SupportId, ExternalId, GearId, SensorId>;

template <class PlaceId>
[[nodiscard]] constexpr Id IdOf(PlaceId id) noexcept {
  return static_cast<Id>(id);
}

/// No default, and the cases are those of the enums above: the compiler names a new effect here.
[[nodiscard]] constexpr PlacedId Placed(Id id) {
  switch (id) {
    case IdOf(TimingId::kExtraDelay):
    case IdOf(TimingId::kDroppedSamples):
    case IdOf(TimingId::kSampleJitter):
      return static_cast<TimingId>(id);
    case IdOf(AmplifierId::kAmplifierBandwidth):
    case IdOf(AmplifierId::kAmplifierSlew):
    case IdOf(AmplifierId::kCurrentGain):
    case IdOf(AmplifierId::kCommandOffset):
      return static_cast<AmplifierId>(id);
    case IdOf(MagnetId::kForceConstant):
    case IdOf(MagnetId::kDisplacementStiffness):
    case IdOf(MagnetId::kCoilAsymmetry):
    case IdOf(MagnetId::kMagneticSaturation):
    case IdOf(MagnetId::kHysteresis):
    case IdOf(MagnetId::kEddyCurrent):
    case IdOf(MagnetId::kMagneticCoupling):
    case IdOf(MagnetId::kAxisRotation):
      return static_cast<MagnetId>(id);
    case IdOf(RotorId::kUnbalance):
    case IdOf(RotorId::kShaftBow):
    case IdOf(RotorId::kShaftAnisotropy):
    case IdOf(RotorId::kModalFrequency):
    case IdOf(RotorId::kModalDamping):
    case IdOf(RotorId::kGyroscopicInertia):
    case IdOf(RotorId::kInternalDamping):
    case IdOf(RotorId::kRotorMass):
    case IdOf(RotorId::kBreathingCrack):
      return static_cast<RotorId>(id);
    case IdOf(SupportId::kSupportMode):
    case IdOf(SupportId::kTouchdownRub):
      return static_cast<SupportId>(id);
    case IdOf(ExternalId::kMisalignment):
    case IdOf(ExternalId::kCouplingStiffness):
    case IdOf(ExternalId::kCrossCoupledStiffness):
    case IdOf(ExternalId::kStaticLoad):
      return static_cast<ExternalId>(id);
    case IdOf(GearId::kMeshStiffness):
    case IdOf(GearId::kMeshStiffnessVariation):
    case IdOf(GearId::kBacklash):
    case IdOf(GearId::kMeshFriction):
    case IdOf(GearId::kTransmissionError):
    case IdOf(GearId::kGearRunout):
    case IdOf(GearId::kToothCrack):
      return static_cast<GearId>(id);
    case IdOf(SensorId::kSensorGain):
    case IdOf(SensorId::kSensorOffset):
    case IdOf(SensorId::kSensorNonlinearity):
    case IdOf(SensorId::kSensorBandwidth):
    case IdOf(SensorId::kSensorPosition):
    case IdOf(SensorId::kSensorRunout):
    case IdOf(SensorId::kMainsPickup):
    case IdOf(SensorId::kSensorNoise):
      return static_cast<SensorId>(id);
  }
  throw std::logic_error("an effect without a place (plant_sim/effect/placed_id.hpp)");
}

[[nodiscard]] constexpr Place PlaceOf(Id id) { return static_cast<Place>(Placed(id).index()); }

/// Whether rows of the catalogue name the places that their ids have here.
template <class Rows>
[[nodiscard]] constexpr bool AreAtTheirPlaces(const Rows& rows) {
  return std::all_of(rows.begin(), rows.end(),
                     [](const auto& row) { return PlaceOf(row.id) == row.place; });
}

}  // namespace levitas::effect
