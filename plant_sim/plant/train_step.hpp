#pragma once
// Forces of geared shafts within one substep: unbalance at each shaft's own speed, supports, teeth.
//
// Equation   docs/derivations.md (G1)-(G7), (G13)-(G15).
// Thread     one pose per plant. No allocation, no throw.

#include <array>

#include "plant_sim/plant/drive.hpp"
#include "plant_sim/plant/train_model.hpp"

namespace levitas::plant {

/// Where all shafts stand at one instant. The sensor's angle of the first shaft repeats every turn,
/// a gear's place does not: whole turns are counted until everything repeats.
struct TrainPose {
  double angle_rad{};  ///< of the first shaft, 0 <= angle < 2 pi
  double turns{};      ///< whole turns of it, below TrainModel::turns_per_repeat
  double speed_rad_per_s{};
  double acceleration_rad_per_s2{};
  std::array<double, kMaxShafts> shaft_rad{};
  std::array<gear::Vector, kMaxShafts> heading{};  ///< exp(j angle) of each shaft
  std::array<gear::Vector, kMaxGears> mesh{};      ///< exp(j tooth angle) of each gear pair
  /// Run-outs and transmission error of each gear pair: the end of a substep is the next one's
  /// start, so they are worth keeping.
  std::array<gear::Prescribed, kMaxGears> prescribed{};
  /// Modal accelerations of the torsion by torques from outside; null: there are none.
  const double* outside{nullptr};
};

/// Follows the rotation; an angle that jumps by more than half a turn has passed a whole one.
void Follow(const TrainModel& train, const Rotation& rotation, TrainPose& pose) noexcept;

/// Adds the modal accelerations of two planes and sets those of the torsion behind them.
void AddTrain(const TrainModel& train, const TrainPose& pose, std::size_t modes,
              const double* position, const double* velocity, double* acceleration) noexcept;

}  // namespace levitas::plant
