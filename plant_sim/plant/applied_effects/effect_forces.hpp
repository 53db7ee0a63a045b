#pragma once
// Forces that effects add to, or change in, one substep: magnets, housings, rotor, surroundings.
//
// Equations  docs/effects.md. Called only where EffectModel says that there is something to do.
// Thread     one Motion per thread. No allocation, no throw.

#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/plant/time_step.hpp"

namespace levitas::plant {

struct PlaneForce {
  double x_n{};
  double y_n{};
};

/// What the magnet and the rubbing rings of a bearing do; (x, y) is relative to its housing.
[[nodiscard]] PlaneForce MagnetWithEffects(const BearingModel& bearing,
                                           const BearingEffects& effects, const Currents& currents,
                                           std::size_t axis, double x_m, double y_m) noexcept;

/// The rubbing rings that a journal touches, if any.
[[nodiscard]] PlaneForce Rub(const BearingModel& bearing, const BearingEffects& effects, double x_m,
                             double y_m, double vx_m_per_s, double vy_m_per_s,
                             double speed_rad_per_s, ForceReport& report) noexcept;

/// Adds the modal accelerations of EffectModel::motions.
void AddEffectForces(const PlantModel& model, const Spin& spin, const double* position,
                     const double* velocity, double* acceleration) noexcept;

}  // namespace levitas::plant
