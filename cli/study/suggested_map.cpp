#include "cli/study/suggested_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "analysis/records/recorded_rows.hpp"
#include "common/problem.hpp"
#include "diagnosis/record_errors/find.hpp"
#include "session/column_guess.hpp"
#include "session/column_map.hpp"
#include "session/csv_rows.hpp"
#include "session/mat_rows.hpp"
#include "session/measured_data.hpp"
#include "session/record_frame.hpp"
#include "session/recording.hpp"

namespace levitas::cli {
namespace {

using session::GuessedColumn;

session::ColumnMap MapOf(const session::ColumnGuess& guess, double rate_hz) {
  session::ColumnMap map;
  map.rate_hz = rate_hz;
  for (const GuessedColumn& column : guess.columns) {
    if (column.quantity.empty() || column.unit.empty()) continue;
    if (rate_hz > 0.0 && column.quantity == "time") continue;
    map.columns.push_back({column.column, column.quantity, column.unit, 1, 1.0, 0.0});
  }
  return map;
}

diagnosis::Record Load(const std::string& path, const config::RigFile& rig,
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
                            const session::ColumnGuess& guess) {
  for (std::size_t i = 0; i < guess.columns.size(); ++i) {
    if (guess.columns[i].quantity != "time") continue;
    std::vector<double> times_s = sampled.values[i];
    const std::string& unit = guess.columns[i].unit;
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

Use UseOf(const GuessedColumn& column, const RigNumbers& rig, const diagnosis::RecordErrors& found,
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

std::string LineOf(const GuessedColumn& column, const Use& use) {
  std::string name;
  for (const char c : column.column) {
    if (c == '"' || c == '\\') name += '\\';
    name += c;
  }
  std::string line =
      fmt::format("  - {{column: \"{}\", is: {}, unit: {}", name, use.quantity, column.unit);
  if (use.factor < 0.0) line += ", sign: -1";
  if (std::abs(use.factor) != 1.0) line += fmt::format(", scale: {:.12g}", std::abs(use.factor));
  return line + "}\n";
}

}  // namespace

SuggestedMap SuggestMap(const std::string& data_path, const config::RigFile& rig,
                        const std::string& import) {
  const session::SampledColumns sampled =
      data_path.ends_with(".mat") ? session::SampleMat(data_path, rig.log.matrix, rig.log.rows)
                                  : session::SampleColumns(data_path);
  const session::ColumnGuess guess = session::GuessColumns(sampled, rig.numbers);
  const double rate_hz = 1.0 / rig.numbers.period_s();
  diagnosis::Record loaded;
  bool by_rate = guess.periods_a_row == 0.0;
  try {
    loaded = Load(data_path, rig, MapOf(guess, by_rate ? rate_hz : 0.0));
    if (by_rate) loaded.times_s.clear();
  } catch (const BadInput&) {
    // Times that are no whole periods of the rig; whatever else is wrong is said once more.
    by_rate = true;
    loaded = Load(data_path, rig, MapOf(guess, rate_hz));
    loaded.times_s = TimesOf(sampled, guess);
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
  bool has_speed = false;
  for (const GuessedColumn& column : guess.columns) {
    has_speed = has_speed || column.quantity == "speed";
  }
  for (const GuessedColumn& column : guess.columns) {
    if (column.quantity.empty() || column.unit.empty()) continue;
    if (by_rate && column.quantity == "time") continue;
    out.text += LineOf(column, UseOf(column, rig.numbers, out.found, has_speed));
  }
  return out;
}

}  // namespace levitas::cli
