#pragma once
// Refuses a rig that cannot exist: std::invalid_argument naming what was found and what is allowed.
// (Files are checked with line and column before; this guards descriptions built in a program.)

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::plant {

void CheckConfig(const PlantConfig& config);

}  // namespace levitas::plant
