#pragma once
// Whole rigs drawn from a seed: rotor, two bearings anywhere, delay, polarity, gravity, unbalance.

#include "plant_sim/plant/plant.hpp"

namespace levitas::plant {

/// Noise-free, unquantised, with touchdown bearings; everything else drawn.
[[nodiscard]] PlantConfig RandomPlant(std::uint64_t seed);

/// The same rig without gravity, unbalance, touchdown bearings and material damping.
[[nodiscard]] PlantConfig RandomFreeRotor(std::uint64_t seed);

/// Coils off, speed held.
[[nodiscard]] PlantCommand HeldSpeed(double speed_rad_per_s);

/// Command `step` of a smooth sequence with another phase on each axis, speed held.
[[nodiscard]] PlantCommand Wave(int step, double amplitude_a, double speed_rad_per_s);

/// Gives every modal velocity a random value; the energy is of the order of 1 mJ.
void Kick(Plant& plant, std::uint64_t seed);

/// Kinetic and strain energy [J] of the rotor, both planes.
[[nodiscard]] double Energy(const Plant& plant);

}  // namespace levitas::plant
