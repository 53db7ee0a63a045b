#pragma once
// What one reading of a position sensor adds to the true position.
//
// Equation   sqrt(noise_rms^2 + step^2/12), step = 2 range / 2^bits of the converter; no
//            converter, no step.
// Thread     pure.

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

/// [m] rms, noise and quantisation.
[[nodiscard]] double ReadingNoise(const plant::SensorConfig& sensor);

}  // namespace levitas::analysis
