#pragma once
// The numbers of a rig by name, for identification, diagnosis and sweeps.
//
// Names      as in the rig description: "rotor.modes[2].frequency_hz", "bearings[0].magnet.gap_m",
//            "bearings[1].sensor.gain", "unbalance[0].phase_rad", "delay_samples",
//            "effects[0].tau_s", "effects[0].strength"; the unit is the suffix. ParameterNames
//            lists all that a rig has. Whole numbers (bits, substeps) and what would change the
//            finite elements (lengths, masses) are not among them.
// Use        auto p = model.parameters(); SetParameter(p, name, value);
//            Plant plant(std::make_shared<const PlantModel>(p), seed);
// Failure    an unknown name: BadInput that names the nearest one. An impossible value is found by
//            the constructor of PlantModel.
// Thread     any; allocates.

#include <string>
#include <string_view>
#include <vector>

#include "plant_sim/plant/plant_model.hpp"

namespace levitas::plant {

[[nodiscard]] std::vector<std::string> ParameterNames(const PlantParameters& parameters);
[[nodiscard]] double GetParameter(const PlantParameters& parameters, std::string_view name);
void SetParameter(PlantParameters& parameters, std::string_view name, double value);

}  // namespace levitas::plant
