#include "cli/study/identify/sensor_options.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "common/problem.hpp"

namespace levitas::cli {

void AddSensorOptions(CLI::App& command, SensorOptions& options) {
  command.add_option("--sensor-a2", options.a2, "Known characteristic, per output")->delimiter(',');
  command.add_option("--sensor-a3", options.a3, "Known characteristic, per output")->delimiter(',');
}

std::vector<identification::SensorCharacteristic> SensorsOf(const SensorOptions& given,
                                                            Eigen::Index outputs) {
  if (given.a2.empty() && given.a3.empty()) return {};
  std::vector<identification::SensorCharacteristic> sensors(static_cast<std::size_t>(outputs));
  for (const auto* values : {&given.a2, &given.a3}) {
    if (values->empty()) continue;
    if (values->size() != sensors.size()) {
      throw Problem(
          ExitStatus::kUsage,
          fmt::format("{}: {} numbers for {} outputs; give one per output, in their order",
                      values == &given.a2 ? "--sensor-a2" : "--sensor-a3", values->size(),
                      sensors.size()));
    }
    for (std::size_t i = 0; i < values->size(); ++i) {
      (values == &given.a2 ? sensors[i].a2 : sensors[i].a3) = (*values)[i];
    }
  }
  return sensors;
}

}  // namespace levitas::cli
