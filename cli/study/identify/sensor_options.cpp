#include "cli/study/identify/sensor_options.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "common/problem.hpp"
#include "identification/probe/probe_characteristic.hpp"
#include "rt/say.hpp"

namespace levitas::cli {
namespace {

std::vector<identification::SensorCharacteristic> OfTables(const std::vector<std::string>& paths,
                                                           Eigen::Index outputs) {
  const auto count = static_cast<std::size_t>(outputs);
  if (paths.size() != 1 && paths.size() != count) {
    throw Problem(ExitStatus::kUsage,
                  fmt::format("--sensor-table: {} files for {} outputs; give one per output, in "
                              "their order, or one for all",
                              paths.size(), count));
  }
  std::vector<identification::SensorCharacteristic> sensors;
  for (const std::string& path : paths) {
    const auto found = identification::FitProbe(identification::ReadPlatformTable(path), path);
    if (!found.cubic_suffices.value_or(true)) {
      rt::Say(
          fmt::format("warning: {}: no cubic describes this probe, a place is off by {:.3g} {}; "
                      "amb identify characteristic {} shows the curve\n",
                      path, 1e6 * found.largest_misfit, found.volts ? "uV" : "um", path));
    }
    sensors.push_back(found.Cubic());
  }
  sensors.resize(count, sensors.front());
  return sensors;
}

}  // namespace

void AddSensorOptions(CLI::App& command, SensorOptions& options) {
  auto* a2 = command.add_option("--sensor-a2", options.a2, "Known characteristic, per output")
                 ->delimiter(',');
  auto* a3 = command.add_option("--sensor-a3", options.a3, "Known characteristic, per output")
                 ->delimiter(',');
  command
      .add_option("--sensor-table", options.tables,
                  "The same from tables of a positioning platform (amb identify characteristic), "
                  "one per output or one for all; outputs in metres")
      ->delimiter(',')
      ->excludes(a2)
      ->excludes(a3);
}

std::vector<identification::SensorCharacteristic> SensorsOf(const SensorOptions& given,
                                                            Eigen::Index outputs) {
  if (!given.tables.empty()) return OfTables(given.tables, outputs);
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
