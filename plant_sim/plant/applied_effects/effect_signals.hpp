#pragma once
// Effects on signals: the memory of the iron between coil current and force, and what a sensor
// reads beside the motion.
//
// Equations  docs/effects.md. Called only where EffectModel says that there is something to do.
// Thread     that of the plant. No allocation, no throw.

#include <span>

#include "plant_sim/plant/plant_model.hpp"

namespace levitas::plant {

/// What magnetises the iron, in the axes of the magnets.
struct MagnetInput {
  AxisArray control_a{};       ///< in the coils
  AxisArray displacement_m{};  ///< of the rotor in the magnet
};

/// Displacement along the axes of the magnets, which may be turned, from that along those of the
/// bearings.
[[nodiscard]] AxisArray SeenByMagnets(const EffectModel& effects,
                                      const AxisArray& position_m) noexcept;

/// The control currents that make force, given what magnetises and the states of the effects.
[[nodiscard]] AxisArray Magnetising(const EffectModel& effects, const MagnetInput& input,
                                    const double* state) noexcept;
/// Moves hysteresis and eddy states over a substep, at whose ends the input is known.
void AdvanceMemory(const EffectModel& effects, const StepTable& table, const MagnetInput& before,
                   const MagnetInput& after, double* state) noexcept;
/// Eddy states as they are when the input has not changed for long.
void SettleMemory(const EffectModel& effects, const MagnetInput& input, double* state) noexcept;

/// What stands before the sensors' filters instead of the displacement at their planes.
void View(const PlantModel& model, double cosine, double sine, const double* state,
          AxisArray& seen_m) noexcept;

/// Added behind the filters: offset and mains pickup.
void AddOutputs(const EffectModel& effects, std::size_t axes, double time_s,
                AxisArray& output_m) noexcept;

}  // namespace levitas::plant
