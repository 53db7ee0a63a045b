#pragma once
// The ids by place, each place with an enum of its own.
//
// Use        Who treats effects place by place visits Placed(id), or switches over the enum of one
//            place, without a default: the compiler then names what a new effect lacks.
// New effect its row in the catalogue does not compile before the id has its place here; then the
//            switches over that place's enum name the rest.
// Thread     any; constant data. Failure: Placed() of no id is a programming error
//            (std::logic_error).

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
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
enum class CoilId : IdNumber {
  kSupplyVoltage = NumberOf(Id::kSupplyVoltage),
  kCoilResistance = NumberOf(Id::kCoilResistance),
  kCoilInductance = NumberOf(Id::kCoilInductance),
  kInductanceProfile = NumberOf(Id::kInductanceProfile),
  kVoltageDrop = NumberOf(Id::kVoltageDrop),
  kDriveNonlinearity = NumberOf(Id::kDriveNonlinearity),
  kDriveAsymmetry = NumberOf(Id::kDriveAsymmetry),
  kCoilHeating = NumberOf(Id::kCoilHeating),
  kMotionEmf = NumberOf(Id::kMotionEmf),
  kMutualInductance = NumberOf(Id::kMutualInductance),
  kCurrentSensorGain = NumberOf(Id::kCurrentSensorGain),
  kCurrentSensorOffset = NumberOf(Id::kCurrentSensorOffset),
  kCurrentSensorBandwidth = NumberOf(Id::kCurrentSensorBandwidth),
  kForceExponent = NumberOf(Id::kForceExponent),
};
enum class BallId : IdNumber {
  kViscousDamping = NumberOf(Id::kViscousDamping),
  kDryFriction = NumberOf(Id::kDryFriction),
};

/// In the order of Place.
using PlacedId = std::variant<TimingId, AmplifierId, MagnetId, RotorId, SupportId, ExternalId,
                              GearId, SensorId, CoilId, BallId>;

template <class PlaceId>
[[nodiscard]] constexpr Id IdOf(PlaceId id) noexcept {
  return static_cast<Id>(id);
}

namespace placed_id {

/// Of every number the place, or kNone.
inline constexpr std::uint8_t kNone = 255;
using Places = std::array<std::uint8_t, 256>;

template <class PlaceId>
constexpr void Put(Places& places, Place place, std::initializer_list<PlaceId> ids) {
  for (const PlaceId id : ids) places[NumberOf(IdOf(id))] = static_cast<std::uint8_t>(place);
}

[[nodiscard]] constexpr Places MakePlaces() {
  Places places{};
  places.fill(kNone);
  {
    using enum TimingId;
    Put(places, Place::kTiming, {kExtraDelay, kDroppedSamples, kSampleJitter});
  }
  {
    using enum AmplifierId;
    Put(places, Place::kAmplifier,
        {kAmplifierBandwidth, kAmplifierSlew, kCurrentGain, kCommandOffset});
  }
  {
    using enum MagnetId;
    Put(places, Place::kMagnet,
        {kForceConstant, kDisplacementStiffness, kCoilAsymmetry, kMagneticSaturation, kHysteresis,
         kEddyCurrent, kMagneticCoupling, kAxisRotation});
  }
  {
    using enum RotorId;
    Put(places, Place::kRotor,
        {kUnbalance, kShaftBow, kShaftAnisotropy, kModalFrequency, kModalDamping,
         kGyroscopicInertia, kInternalDamping, kRotorMass, kBreathingCrack});
  }
  {
    using enum SupportId;
    Put(places, Place::kSupport, {kSupportMode, kTouchdownRub});
  }
  {
    using enum ExternalId;
    Put(places, Place::kExternal,
        {kMisalignment, kCouplingStiffness, kCrossCoupledStiffness, kStaticLoad});
  }
  {
    using enum GearId;
    Put(places, Place::kGear,
        {kMeshStiffness, kMeshStiffnessVariation, kBacklash, kMeshFriction, kTransmissionError,
         kGearRunout, kToothCrack});
  }
  {
    using enum SensorId;
    Put(places, Place::kSensor,
        {kSensorGain, kSensorOffset, kSensorNonlinearity, kSensorBandwidth, kSensorPosition,
         kSensorRunout, kMainsPickup, kSensorNoise});
  }
  {
    using enum CoilId;
    Put(places, Place::kCoil,
        {kSupplyVoltage, kCoilResistance, kCoilInductance, kInductanceProfile, kVoltageDrop,
         kDriveNonlinearity, kDriveAsymmetry, kCoilHeating, kMotionEmf, kMutualInductance,
         kCurrentSensorGain, kCurrentSensorOffset, kCurrentSensorBandwidth, kForceExponent});
  }
  {
    using enum BallId;
    Put(places, Place::kBall, {kViscousDamping, kDryFriction});
  }
  return places;
}
inline constexpr Places kPlaces = MakePlaces();

}  // namespace placed_id

/// An id without a place is refused while compiling where it is known then, as in the rows of the
/// catalogue: a new one has to stand in an enum above and in MakePlaces().
[[nodiscard]] constexpr PlacedId Placed(Id id) {
  switch (static_cast<Place>(placed_id::kPlaces[NumberOf(id)])) {
    case Place::kTiming:
      return static_cast<TimingId>(id);
    case Place::kAmplifier:
      return static_cast<AmplifierId>(id);
    case Place::kMagnet:
      return static_cast<MagnetId>(id);
    case Place::kRotor:
      return static_cast<RotorId>(id);
    case Place::kSupport:
      return static_cast<SupportId>(id);
    case Place::kExternal:
      return static_cast<ExternalId>(id);
    case Place::kGear:
      return static_cast<GearId>(id);
    case Place::kSensor:
      return static_cast<SensorId>(id);
    case Place::kCoil:
      return static_cast<CoilId>(id);
    case Place::kBall:
      return static_cast<BallId>(id);
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
