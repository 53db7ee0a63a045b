#include "cli/study/suggested_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "analysis/records/recorded_rows.hpp"
#include "common/problem.hpp"
#include "diagnosis/record_errors/find.hpp"
#include "session/exchange/column_guess.hpp"
#include "session/exchange/column_map.hpp"
#include "session/exchange/csv_rows.hpp"
#include "session/exchange/mat_rows.hpp"
#include "session/exchange/measured_data.hpp"
#include "session/exchange/recording.hpp"
#include "session/log/record_frame.hpp"

namespace levitas::cli {
namespace {

using session::GuessedColumn;
using session::MappedColumn;

session::ColumnMap MapOf(const session::ColumnGuess& guess) {
  session::ColumnMap map;
  for (const GuessedColumn& column : guess.columns) {
    if (column.quantity.empty() || column.unit.empty()) continue;
    map.columns.push_back({column.column, column.quantity, column.unit, 1, 1.0, 0.0});
  }
  return map;
}

session::ColumnMap WithoutTimes(session::ColumnMap map, double rate_hz) {
  map.rate_hz = rate_hz;
  std::erase_if(map.columns, [](const MappedColumn& column) { return column.quantity == "time"; });
  return map;
}

/// A map that is there already, with the columns that are read by their own names beside it.
session::ColumnMap Completed(session::ColumnMap map, const session::ColumnGuess& guess) {
  const std::size_t named = map.columns.size();
  for (const GuessedColumn& column : guess.columns) {
    const auto same = [&column](const MappedColumn& other) {
      return other.column == column.column || other.quantity == column.quantity;
    };
    const auto end = map.columns.begin() + static_cast<std::ptrdiff_t>(named);
    const bool own_name = column.column == column.quantity + "_" + column.unit;
    if (!own_name || std::any_of(map.columns.begin(), end, same)) continue;
    map.columns.push_back({column.column, column.quantity, column.unit, 1, 1.0, 0.0});
  }
  return map;
}

diagnosis::Record Load(const std::string& path, const configuration::RigFile& rig,
                       const session::ColumnMap& map) {
  diagnosis::Record out;
  out.name = std::filesystem::path(path).filename().string();
  std::unique_ptr<session::RowSource> rows;
  if (path.ends_with(".mat")) {
    rows = std::make_unique<session::MatRows>(path, rig.numbers.channels, rig.log.matrix,
                                              rig.log.rows, &map);
  } else {
    rows = std::make_unique<session::CsvRows>(path, rig.numbers.channels, &map);
  }
  const session::RecordFrame frame(rig.numbers);
  const auto take = [&](const cycle::CycleRecord& cycle) {
    const session::AxisSample sample = frame.Bearing(cycle);
    analysis::RecordedRow row;
    row.cycle = cycle.in.frame.cycle;
    row.levitated = session::IsLevitated(cycle, rig.numbers.axes());
    row.sample.position_m = sample.position_m;
    row.sample.command = {};
    row.sample.command.control_current_a = sample.current_a;
    row.sample.speed_rad_per_s = cycle.in.frame.speed_rad_per_s;
    row.sample.angle_rad = cycle.in.frame.angle_rad;
    row.excitation_a = cycle.in.op.excitation_a;
    out.rows.push_back(row);
    out.times_s.push_back(1e-9 * static_cast<double>(cycle.in.frame.sample_time_ns));
  };
  static_cast<void>(session::ReadRecords(*rows, {.rig = rig.numbers, .coils = {}}, take));
  out.mean_speed_rad_per_s = analysis::MeanSpeed(out.rows);
  return out;
}

/// [s] of the first rows, as they stand in the file.
std::vector<double> TimesOf(const session::SampledColumns& sampled,
                            const session::ColumnMap& columns) {
  for (const MappedColumn& column : columns.columns) {
    const auto at = std::ranges::find(sampled.names, column.column);
    if (column.quantity != "time" || at == sampled.names.end()) continue;
    std::vector<double> times_s =
        sampled.values[static_cast<std::size_t>(at - sampled.names.begin())];
    const std::string& unit = column.unit;
    const double seconds = unit == "ms" ? 1e-3 : unit == "us" ? 1e-6 : unit == "ns" ? 1e-9 : 1.0;
    for (double& time : times_s) time *= seconds;
    return times_s;
  }
  return {};
}

/// What a column is, and the factor of its numbers.
struct Use {
  std::string quantity;
  double factor{1.0};
};

Use UseOf(const MappedColumn& column, const RigNumbers& rig, const diagnosis::RecordErrors& found,
          bool has_speed) {
  if (column.quantity == "speed") return {column.quantity, found.speed_factor};
  if (column.quantity == "rotor_angle") {
    return {column.quantity, has_speed ? found.angle_factor : found.speed_factor};
  }
  for (const bool position : {true, false}) {
    const std::string prefix = position ? "position_" : "control_current_";
    const AxisArray& polarity = position ? rig.sensor_polarity : rig.actuator_polarity;
    for (std::size_t a = 0; a < rig.axes(); ++a) {
      const diagnosis::ColumnUse& use = (position ? found.uses.position : found.uses.current)[a];
      if (column.quantity != prefix + rig.channels[use.from]) continue;
      const double wires = polarity[a] * polarity[use.from] < 0.0 ? -1.0 : 1.0;
      return {prefix + rig.channels[a], wires * use.factor};
    }
  }
  return {column.quantity, 1.0};
}

std::string LineOf(const MappedColumn& column, const Use& use) {
  std::string name;
  for (const char c : column.column) {
    if (c == '"' || c == '\\') name += '\\';
    name += c;
  }
  std::string line =
      fmt::format("  - {{column: \"{}\", is: {}, unit: {}", name, use.quantity, column.unit);
  const double factor = use.factor * column.sign * column.scale;
  if (factor < 0.0) line += ", sign: -1";
  if (std::abs(factor) != 1.0) line += fmt::format(", scale: {:.12g}", std::abs(factor));
  if (column.offset != 0.0) line += fmt::format(", offset: {:.12g}", column.offset);
  return line + "}\n";
}

}  // namespace

SuggestedMap SuggestMap(const std::string& data_path, const configuration::RigFile& rig,
                        const session::ColumnMap* map, const std::string& import) {
  const session::SampledColumns sampled =
      data_path.ends_with(".mat") ? session::SampleMat(data_path, rig.log.matrix, rig.log.rows)
                                  : session::SampleColumns(data_path);
  const session::ColumnGuess guess = session::GuessColumns(sampled, rig.numbers);
  const double rate_hz = 1.0 / rig.numbers.period_s();
  const session::ColumnMap columns = map != nullptr ? Completed(*map, guess) : MapOf(guess);
  diagnosis::Record loaded;
  bool by_rate = map != nullptr ? map->rate_hz > 0.0 : guess.periods_a_row == 0.0;
  try {
    loaded = Load(data_path, rig, by_rate ? WithoutTimes(columns, rate_hz) : columns);
    if (by_rate) loaded.times_s.clear();
  } catch (const BadInput&) {
    // Times that are no whole periods of the rig; whatever else is wrong is said once more.
    by_rate = true;
    loaded = Load(data_path, rig, WithoutTimes(columns, rate_hz));
    loaded.times_s = TimesOf(sampled, columns);
  }
  const diagnosis::RigView view(rig.numbers, rig.plant);
  SuggestedMap out{{}, diagnosis::FindRecordErrors(view, loaded)};
  by_rate = by_rate || out.found.time_factor != 1.0 || out.found.drifts;
  out.text = fmt::format("# Columns of {} as controller and rig show them to be.\n# Then: {}\n",
                         data_path, import);
  if (out.found.errors.empty()) out.text += "# No error of the record was found.\n";
  for (const std::string& sentence : diagnosis::RecordErrorSentences({out.found})) {
    out.text += "# " + sentence + "\n";
  }
  out.text += "kind: import_map\n";
  if (by_rate) out.text += fmt::format("rate_hz: {:g}\n", rate_hz);
  out.text += "columns:\n";
  const bool has_speed = std::ranges::any_of(
      columns.columns, [](const MappedColumn& column) { return column.quantity == "speed"; });
  for (const MappedColumn& column : columns.columns) {
    if (by_rate && column.quantity == "time") continue;
    out.text += LineOf(column, UseOf(column, rig.numbers, out.found, has_speed));
  }
  return out;
}

}  // namespace levitas::cli
