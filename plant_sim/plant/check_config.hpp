#pragma once
// Refuses a rig that cannot exist: std::invalid_argument naming what was found and what is allowed.
// (Files are checked with line and column before; this guards descriptions built in a program.)

#include <cstddef>

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::plant {

void CheckConfig(const PlantConfig& config);
/// Entries of effects: their values, what they refer to, and that no two fight for one place.
void CheckEffects(const PlantConfig& config);
void CheckMode(std::size_t mode, double frequency_rad_per_s, double damping_ratio);

}  // namespace levitas::plant
