#pragma once
// --sensor-a2, --sensor-a3, or --sensor-table: characteristic of each sensor, known beforehand as
// numbers or as it was measured on a positioning platform (identification/probe).

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "identification/nonlinear/hammerstein_wiener.hpp"

namespace levitas::cli {

struct SensorOptions {
  std::vector<double> a2, a3;       ///< per output
  std::vector<std::string> tables;  ///< files, per output or one for all
};

void AddSensorOptions(CLI::App& command, SensorOptions& options);

/// Per output; empty when none is given. A usage problem when the numbers or tables are not as
/// many; BadInput of a table. Of a table gain and offset are left out: a model has them itself.
[[nodiscard]] std::vector<identification::SensorCharacteristic> SensorsOf(
    const SensorOptions& options, Eigen::Index outputs);

}  // namespace levitas::cli
