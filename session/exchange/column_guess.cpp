#include "session/exchange/column_guess.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string_view>

#include "common/nearest.hpp"
#include "session/exchange/column_words.hpp"
#include "session/exchange/csv_columns.hpp"
#include "session/exchange/csv_head.hpp"
#include "session/exchange/file_kind.hpp"
#include "session/exchange/mat_file.hpp"

namespace levitas::session {
namespace {

struct Range {
  double low{std::numeric_limits<double>::quiet_NaN()};
  double high{std::numeric_limits<double>::quiet_NaN()};
  [[nodiscard]] double Largest() const { return std::max(std::abs(low), std::abs(high)); }
  [[nodiscard]] double Swing() const { return 0.5 * (high - low); }
};

Range RangeOf(const std::vector<double>& values) {
  Range range;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    range.low = std::isnan(range.low) ? value : std::min(range.low, value);
    range.high = std::isnan(range.high) ? value : std::max(range.high, value);
  }
  return range;
}

double MedianStep(const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(values[i] - values[i - 1]);
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

struct Candidate {
  std::string_view unit;
  double per_unit;  ///< so many of it are one of SI
};

/// The unit in which `value` is at most `most` and nearest to it: a thousand lies between two.
std::string UnitByValue(double value, double most, const std::vector<Candidate>& candidates) {
  for (const Candidate& candidate : candidates) {
    const double share = value / candidate.per_unit / most;
    if (share <= 1.0 && share > 1e-3) return std::string(candidate.unit);
  }
  return {};
}

/// `swing` is the largest of all columns of the dimension that say no unit: one logger, one unit.
std::string UnitByValues(const NameMeaning& meaning, const std::vector<double>& values,
                         double swing, const RigNumbers& rig) {
  switch (meaning.dimension) {
    case Dimension::kLength:
      return UnitByValue(swing, rig.SensorRangeOf(meaning.axis.value_or(0) / 2),
                         {{"m", 1.0}, {"mm", 1e3}, {"um", 1e6}});
    case Dimension::kCurrent:
      return UnitByValue(swing, rig.max_coil_current_a, {{"a", 1.0}, {"ma", 1e3}});
    case Dimension::kTime: {
      constexpr double kOfPeriods = 30.0;  // the file's rate may be another than the rig's
      return UnitByValue(MedianStep(values), kOfPeriods * rig.period_s(),
                         {{"s", 1.0}, {"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}});
    }
    case Dimension::kAngle:
      return RangeOf(values).Largest() > 2.0 * std::numbers::pi * kMostTurns + 1.0 ? "deg" : "rad";
    case Dimension::kSpeed:
      return "rpm";
    case Dimension::kNone:
      return {};
  }
  return {};
}

std::string QuantityOf(const NameMeaning& meaning, const RigNumbers& rig) {
  switch (meaning.dimension) {
    case Dimension::kTime:
      return "time";
    case Dimension::kAngle:
      return "rotor_angle";
    case Dimension::kSpeed:
      return "speed";
    case Dimension::kNone:
      return {};
    case Dimension::kLength:
    case Dimension::kCurrent:
      break;
  }
  if (!meaning.axis) return {};
  const std::string& channel = rig.channels[*meaning.axis];
  if (meaning.excitation) return "excitation_" + channel;
  if (meaning.dimension == Dimension::kCurrent) return "control_current_" + channel;
  return (meaning.gap ? "gap_" : "position_") + channel;
}

std::vector<std::string> MissingOf(const std::set<std::string>& found, const RigNumbers& rig) {
  std::vector<std::string> missing;
  for (const std::string& channel : rig.channels) {
    if (!found.contains("position_" + channel) && !found.contains("gap_" + channel)) {
      missing.push_back("position_" + channel);
    }
  }
  for (const std::string& channel : rig.channels) {
    if (!found.contains("control_current_" + channel)) {
      missing.push_back("control_current_" + channel);
    }
  }
  return missing;
}

double SecondsOf(const std::string& unit) {
  if (unit == "ms") return 1e-3;
  if (unit == "us") return 1e-6;
  return unit == "ns" ? 1e-9 : 1.0;
}

std::string Escaped(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text;
}

std::string LineOf(const GuessedColumn& column) {
  const std::string seen = std::isnan(column.low)
                               ? std::string("no numbers")
                               : fmt::format("{:.6g} to {:.6g}", column.low, column.high);
  const std::string name = fmt::format("{{column: \"{}\"", Escaped(column.column));
  if (column.quantity.empty())
    return fmt::format("  # - {}, is: ?, unit: ?}}   # not understood; {}\n", name, seen);
  const bool channel =
      column.quantity.find('_') != std::string::npos && column.quantity != "rotor_angle";
  const std::string line =
      fmt::format("  - {}, is: {}, unit: {}{}}}", name, column.quantity,
                  column.unit.empty() ? "?" : column.unit, channel ? ", sign: 1, offset: 0" : "");
  const char* why = column.unit.empty()     ? "; in which unit?"
                    : column.unit_by_values ? "; unit guessed from these numbers"
                                            : "";
  const double middle = 0.5 * (column.low + column.high);
  const bool away = channel && std::abs(middle) > 3.0 * (column.high - column.low);
  return fmt::format("{:<90} # {}{}{}\n", line, seen, why,
                     away ? fmt::format("; is {:.3g} its offset?", middle) : std::string{});
}

}  // namespace

SampledColumns SampleColumns(const std::string& path) {
  RefuseOtherKind(path);
  LineSource lines(path);
  CsvHead head = ReadCsvHead(lines, path, IsNameOfOurs);
  SampledColumns sampled{head.names, head.units, {}};
  sampled.units.resize(sampled.names.size());
  sampled.values.resize(sampled.names.size());
  std::vector<std::string_view> cells;
  const auto take = [&](std::string_view line) {
    if (IsNoRow(line)) return;
    SplitCsv(line, head.separator, cells);
    for (std::size_t i = 0; i < std::min(cells.size(), sampled.values.size()); ++i) {
      double value = std::numeric_limits<double>::quiet_NaN();
      if (!ParseCell(cells[i], head.separator, value)) {
        value = std::numeric_limits<double>::quiet_NaN();
      }
      sampled.values[i].push_back(value);
    }
  };
  for (const auto& [number, line] : head.ahead) take(line);
  std::string_view line;
  for (std::size_t row = head.ahead.size(); row < kGuessRows && lines.Next(line); ++row) take(line);
  return sampled;
}

SampledColumns SampleMat(const std::string& path, const std::string& matrix,
                         const std::vector<std::string>& matrix_rows) {
  MatTable table = ReadMat(path, matrix, matrix_rows);
  SampledColumns sampled{std::move(table.names), {}, std::move(table.columns)};
  sampled.units.resize(sampled.names.size());
  for (auto& values : sampled.values) values.resize(std::min(values.size(), kGuessRows));
  return sampled;
}

ColumnGuess GuessColumns(const SampledColumns& file, const RigNumbers& rig) {
  ColumnGuess guess;
  std::set<std::string> found;
  std::vector<NameMeaning> meanings;
  std::map<Dimension, double> swing;
  for (std::size_t i = 0; i < file.names.size(); ++i) {
    meanings.push_back(MeaningOf(file.names[i], file.units[i], rig));
    double& largest = swing[meanings[i].dimension];
    if (meanings[i].unit.empty()) largest = std::fmax(largest, RangeOf(file.values[i]).Swing());
  }
  for (std::size_t i = 0; i < file.names.size(); ++i) {
    const NameMeaning& meaning = meanings[i];
    const Range range = RangeOf(file.values[i]);
    GuessedColumn column{file.names[i], QuantityOf(meaning, rig), meaning.unit, false, range.low,
                         range.high};
    // One column for each quantity: of two the first is taken, the other is for a person.
    if (!column.quantity.empty() && !found.insert(column.quantity).second) column.quantity.clear();
    // A column that does not move (a rotor at rest, a first stretch of zeros) tells no unit.
    if (!column.quantity.empty() && column.unit.empty() && range.low < range.high) {
      column.unit = UnitByValues(meaning, file.values[i], swing[meaning.dimension], rig);
      column.unit_by_values = !column.unit.empty();
    }
    if (column.quantity == "time" && !column.unit.empty()) {
      guess.periods_a_row = MedianStep(file.values[i]) * SecondsOf(column.unit) / rig.period_s();
    }
    guess.columns.push_back(std::move(column));
  }
  guess.missing = MissingOf(found, rig);
  return guess;
}

std::string GuessText(const ColumnGuess& guess, const RigNumbers& rig, const std::string& data_path,
                      const std::string& import) {
  std::string text = fmt::format(
      "# What the columns of {} probably are, from their names, units and first rows.\n"
      "# Check every line; no file tells signs and offsets:\n"
      "#   quantity = sign * scale * (number of the file - offset), in the rig's directions\n"
      "# Then: {}\n"
      "kind: import_map\n",
      data_path, import);
  const double rate_hz = 1.0 / rig.period_s();
  if (guess.periods_a_row == 0.0) {
    text += fmt::format("rate_hz: {:g}   # the rig's: no column of times was found\n", rate_hz);
  } else if (std::abs(guess.periods_a_row - 1.0) > 0.25) {
    text += fmt::format(
        "# The file has {:.6g} rows a second, rig {} samples {:g} times: give the rig file the "
        "period of the data (sampling, period_us).\n",
        rate_hz / guess.periods_a_row, rig.name, rate_hz);
  }
  text += "columns:\n";
  for (const GuessedColumn& column : guess.columns) text += LineOf(column);
  if (!guess.missing.empty()) {
    text += "# Needed, and not found: " + Listed(guess.missing) + "\n";
  }
  return text;
}

}  // namespace levitas::session
