#pragma once
// By what a ball between two magnets on a voltage may differ from its rig file: one number each.
//
// Origin     0 is the rig file, so that a set of values is what is wrong with it.
// Equations  coil_run.hpp and motion_run.hpp say where each stands.
// Tolerance  standard deviation on a rig that counts as healthy; 0: not there on a healthy rig.
// Wide       standard deviation when it is the cause that is being looked for.
// Thread     constant data.

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "plant_sim/effect/effect_config.hpp"

namespace levitas::levitator {

enum Parameter : std::size_t {
  kDelay,
  kSupply,
  kResistance,
  kInductance,
  kProfile,
  kIronInductance,
  kDeadBand,
  kCommandUpper,
  kCommandLower,
  kDriveCurve,
  kHeating,
  kMotionEmf,
  kEddyShare,
  kMutual,
  kAwaySupply,
  kAwayInductance,
  kProbeGain,
  kProbeOffset,
  kProbeLag,
  kForce,
  kForceDecay,
  kForceExponent,
  kForceKnee,
  kForceLag,
  kForceAway,
  kSensorGain,
  kSensorOffset,
  kSensorSquare,
  kSensorCube,
  kSensorLag,
  kMass,
  kLoad,
  kDamping,
  kDryFriction,
  kSpring,
  kParameters
};

/// What its value moves.
enum class Side : unsigned char { kCoils, kMotion, kBoth };

struct Row {
  effect::Id effect{};
  std::string_view name;
  std::string_view unit;
  Side side;
  double tolerance;
  double wide;
  double least;  ///< of the value: what can only be there or not has 0
};

[[nodiscard]] std::span<const Row> Table();
[[nodiscard]] const Row& At(Parameter parameter);

/// Numbers that every record has of its own: the coil's resistance when it began (it is warm or
/// cold) and the place of the sensor's zero (it is clamped anew).
enum OwnParameter : std::size_t { kOwnResistance, kOwnOffset, kOwnParameters };
inline constexpr double kOwnResistanceTolerance = 0.007;
inline constexpr double kOwnOffsetToleranceM = 100e-6;

/// Values of all records: the common ones, then those of each record.
using Theta = std::vector<double>;
[[nodiscard]] inline std::size_t Own(std::size_t record, OwnParameter parameter) {
  return kParameters + record * kOwnParameters + parameter;
}
[[nodiscard]] inline Theta Zeros(std::size_t records) {
  return Theta(kParameters + records * kOwnParameters, 0.0);
}

}  // namespace levitas::levitator
