#pragma once
// What a rig does that its nominal model does not: the ids, and one switched-on effect as data.
//
// Ids        part of the contract with files and with `amb diagnose`: added to, never renamed. The
//            table of all (parameters, units, ranges, equations, sources) is catalogue.hpp.
// Units      SI; the order of `values` is that of the effect's parameters in the catalogue.
// Strength   0 = the plant is the nominal one, 1 = as the values say, between them see
//            strength.hpp. It grows from 0 to `strength` during `ramp_s` from `at_s` on.
// Thread     plain data.

#include <array>
#include <cstddef>
#include <cstdint>

namespace levitas::effect {

enum class Id : std::uint8_t {
  kExtraDelay,
  kDroppedSamples,
  kSampleJitter,
  kAmplifierBandwidth,
  kAmplifierSlew,
  kCurrentGain,
  kDisplacementStiffness,
  kCoilAsymmetry,
  kMagneticSaturation,
  kHysteresis,
  kEddyCurrent,
  kAxisRotation,
  kSensorGain,
  kSensorOffset,
  kSensorNonlinearity,
  kSensorBandwidth,
  kSensorPosition,
  kSensorRunout,
  kMainsPickup,
  kSensorNoise,
  kUnbalance,
  kShaftBow,
  kShaftAnisotropy,
  kModalFrequency,
  kModalDamping,
  kGyroscopicInertia,
  kInternalDamping,
  kRotorMass,
  kBreathingCrack,
  kMisalignment,
  kCouplingStiffness,
  kCrossCoupledStiffness,
  kStaticLoad,
  kSupportMode,
  kTouchdownRub,
  kMeshStiffness,
  kMeshStiffnessVariation,
  kBacklash,
  kMeshFriction,
  kTransmissionError,
  kGearRunout,
  kToothCrack,
  kForceConstant,
  kCommandOffset,
  kMagneticCoupling,
  kSupplyVoltage,
  kCoilResistance,
  kCoilInductance,
  kInductanceProfile,
  kVoltageDrop,
  kDriveNonlinearity,
  kDriveAsymmetry,
  kCoilHeating,
  kMotionEmf,
  kMutualInductance,
  kCurrentSensorGain,
  kCurrentSensorOffset,
  kCurrentSensorBandwidth,
  kForceExponent,
  kViscousDamping,
  kDryFriction,
};

/// Where in the loop it sits.
enum class Place : std::uint8_t {
  kTiming,
  kAmplifier,
  kMagnet,
  kRotor,
  kSupport,
  kExternal,
  kGear,
  kSensor,
  kCoil,  ///< on a voltage, and its current probe
  kBall   ///< between two magnets
};

inline constexpr std::size_t kMaxParameters = 8;
inline constexpr std::uint32_t kAllAxes = 0xFFFFFFFFU;

struct EffectConfig {
  Id id{};
  std::uint32_t axes{kAllAxes};  ///< bit a = axis a; for effects of channels
  std::size_t bearing{};         ///< index; for effects of a bearing
  std::size_t mode{1};           ///< flexible mode, 1 = first bending; for effects of a mode
  bool on_sensor{};              ///< axis_rotation: of the sensors, else of the magnets
  std::size_t gear{};            ///< index of the gear pair; for effects of gears
  bool on_driven{};  ///< gear_runout, tooth_crack: of the driven wheel, else the driving
  std::array<double, kMaxParameters> values{};
  double strength{1.0};
  double at_s{};    ///< plant time at which it sets in
  double ramp_s{};  ///< and how long it takes to grow to `strength`; 0 = at once

  [[nodiscard]] bool timed() const noexcept { return at_s > 0.0 || ramp_s > 0.0; }
  [[nodiscard]] bool Acts(std::size_t axis) const noexcept { return ((axes >> axis) & 1U) != 0U; }
};

}  // namespace levitas::effect
