#pragma once
// Where the rotor stands when it does not move: displaced rigidly, or lying in its touchdown
// bearings, bent by its own weight. docs/derivations.md (38)-(40).
// Writes the modal displacements of `state` (all else untouched). No allocation, no throw.

#include <span>

#include "plant_sim/plant/plant_model.hpp"

namespace levitas::plant {

/// Geared shafts bend on their supports, with the least strain that brings the bearings there.
/// Otherwise: two bearings: displacement and tilt. One: no tilt. More: the straight line of least
/// squares.
void PlaceRigidly(const PlantModel& model, const AxisArray& actuator_position_m,
                  std::span<double> state) noexcept;

/// Static equilibrium with gravity; without gravity or without touchdown bearings: the centre.
void PlaceInTouchdown(const PlantModel& model, std::span<double> state) noexcept;

}  // namespace levitas::plant
