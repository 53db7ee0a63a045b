#pragma once
// --sensor-a2, --sensor-a3: characteristic of each sensor, known beforehand.

#include <CLI/App.hpp>
#include <vector>

#include "identification/nonlinear/hammerstein_wiener.hpp"

namespace levitas::cli {

struct SensorOptions {
  std::vector<double> a2, a3;  ///< per output
};

void AddSensorOptions(CLI::App& command, SensorOptions& options);

/// Per output; empty when none is given. A usage problem when the numbers are not as many.
[[nodiscard]] std::vector<identification::SensorCharacteristic> SensorsOf(
    const SensorOptions& options, Eigen::Index outputs);

}  // namespace levitas::cli
