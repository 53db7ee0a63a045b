#pragma once
// Effects on signals: the memory of the iron between coil current and force, and what a sensor
// reads beside the motion.
//
// Equations  docs/effects.md. Called only where EffectModel says that there is something to do.
// Thread     that of the plant. No allocation, no throw.

#include <span>

#include "plant_sim/plant/plant_model.hpp"

namespace levitas::plant {

/// The control currents that make force, given those in the coils and the states of the effects.
[[nodiscard]] AxisArray Magnetising(const EffectModel& effects, const AxisArray& control_a,
                                    const double* state) noexcept;
/// Moves hysteresis and eddy states over a substep in which the coil currents change.
void AdvanceMemory(const EffectModel& effects, const StepTable& table, const AxisArray& before_a,
                   const AxisArray& after_a, double* state) noexcept;

/// What stands before the sensors' filters instead of the displacement at their planes.
void View(const PlantModel& model, double cosine, double sine, const double* state,
          AxisArray& seen_m) noexcept;

/// Added behind the filters: offset and mains pickup.
void AddOutputs(const EffectModel& effects, std::size_t axes, double time_s,
                AxisArray& output_m) noexcept;

}  // namespace levitas::plant
