#pragma once
// Whether the probes of a rig are such as methods need that model a probe by one pole and a
// straight line. Thread: any; pure.

#include <algorithm>

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::plant {

/// Every probe has a filter of first order and no measured curve.
[[nodiscard]] inline bool HasPlainSensors(const PlantConfig& rig) {
  return std::ranges::all_of(rig.bearings, [](const BearingConfig& b) {
    return b.sensor.filter == SensorFilter::kFirstOrder && b.sensor.characteristic.empty();
  });
}

/// What else to say of a rig without: the end of a sentence.
inline constexpr const char* kPlainSensorsOnly =
    "takes probes with `filter: first_order` and without `characteristic` only";

}  // namespace levitas::plant
