#include "session/exchange/column_map.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "common/nearest.hpp"
#include "common/problem.hpp"
#include "configuration/text/read_file.hpp"
#include "session/exchange/csv_head.hpp"

namespace levitas::session {
namespace {

/// A unit of a quantity: cell / divisor is in the quantity's own unit.
struct MapUnit {
  std::string_view name;
  double divisor;
};
/// A quantity of a map; `own` is the ending of the CSV column that holds it in its own unit.
struct MapQuantity {
  std::string_view prefix;
  bool per_axis;
  std::string_view own;
  std::vector<MapUnit> units;
};

const std::vector<MapQuantity>& Quantities() {
  constexpr double kDegree = 180.0 / std::numbers::pi;
  constexpr double kTurn = 0.5 / std::numbers::pi;
  constexpr double kRadPerS = std::numbers::pi / 30.0;
  static const std::vector<MapUnit> lengths{{"m", 1.0}, {"mm", 1e3}, {"um", 1e6}, {"nm", 1e9}};
  static const std::vector<MapUnit> currents{{"a", 1.0}, {"ma", 1e3}};
  static const std::vector<MapUnit> shares{{"share", 1.0}, {"percent", 100.0}};
  static const std::vector<MapQuantity> all{
      {"time", false, "_s", {{"s", 1.0}, {"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}}},
      {"rotor_angle", false, "_rad", {{"rad", 1.0}, {"deg", kDegree}, {"turn", kTurn}}},
      {"speed", false, "_rpm", {{"rpm", 1.0}, {"hz", 1.0 / 60.0}, {"rad_per_s", kRadPerS}}},
      {"position_", true, "_m", lengths},
      {"control_current_", true, "_a", currents},
      {"excitation_", true, "_a", currents},
      {"excitation_", true, "_m", lengths},
      {"gap_", true, "_m", lengths},
      {"duty_towards_", true, "", shares},
      {"duty_away_", true, "", shares},
      {"coil_current_towards_", true, "_a", currents},
      {"coil_current_away_", true, "_a", currents}};
  return all;
}

bool Is(const MapQuantity& kind, const std::string& quantity) {
  if (!kind.per_axis) return quantity == kind.prefix;
  return quantity.starts_with(kind.prefix) && quantity.size() > kind.prefix.size();
}

/// "ma" of "mA", "rpm" of "1/min": the unit as it is meant; empty: none that maps have.
std::string UnitMeant(const std::string& written) {
  for (const MapQuantity& kind : Quantities()) {
    if (std::ranges::find(kind.units, written, &MapUnit::name) != kind.units.end()) return written;
  }
  return written == "%" ? "percent" : UnitWord(written);
}

/// What to do with the numbers of a converter, which are in no unit of the quantity.
std::string RemedyOfUnit(const std::string& written, const std::vector<std::string>& units) {
  std::string word = written;
  std::ranges::transform(word, word.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  const auto is = [&word](auto... others) { return ((word == others) || ...); };
  const bool volts = is("v", "mv", "uv", "volt", "volts");
  if (!volts && !is("count", "counts", "lsb", "bit", "bits", "digit", "digits", "adc")) return {};
  const std::string& unit = units.size() > 1 ? units[1] : units.front();
  return fmt::format(
      ". Numbers in {0} need the sensitivity: unit: {1} with scale: as many {1} as one {2} stands "
      "for (a probe of 8 V/mm has scale: 0.125), and offset: what the file shows at zero",
      written, unit, volts ? written : "count");
}

void DescribeUnit(configuration::Visitor& v, MappedColumn& c) {
  constexpr std::size_t kLongest = 40;
  const std::vector<std::string> units = UnitsOf(c.quantity);
  const std::string meaning = fmt::format("that its numbers are in: {}",
                                          units.empty() ? "mm, ma, rpm, ..." : Listed(units));
  std::string written;
  v.Name({"unit", meaning, {}, kLongest}, written);
  c.unit = UnitMeant(written);
  const bool known = units.empty() ? !c.unit.empty() : std::ranges::count(units, c.unit) > 0;
  if (written.empty() || known) return;
  v.RefuseIf(true, "unit",
             units.empty() ? fmt::format("found \"{}\", which is no unit of a map", written)
                           : fmt::format("found \"{}\", but {} may be in {}{}", written, c.quantity,
                                         Listed(units), RemedyOfUnit(written, units)));
}

void Describe(configuration::Visitor& v, MappedColumn& c) {
  constexpr std::size_t kLongest = 200;
  v.Name({"column", "name in the file, or \"#3\" for the third column", {}, kLongest}, c.column);
  v.Name({"is",
          "time, rotor_angle, speed, position_CHANNEL, control_current_CHANNEL, ...",
          {},
          kLongest},
         c.quantity);
  DescribeUnit(v, c);
  v.Integer({"sign", -1, 1, 1, "-1: the file's plus is the rig's minus"}, c.sign);
  v.RefuseIf(c.sign == 0, "sign", "allowed -1 or 1");
  v.Number(
      {"scale", configuration::unit::kOne, -1e12, 1e12, 1.0, "of the numbers: volts or counts"},
      c.scale);
  v.RefuseIf(c.scale == 0.0, "scale", "must not be 0");
  v.Number({"offset", configuration::unit::kOne, -1e12, 1e12, 0.0, "number of the file at zero"},
           c.offset);
  v.RefuseIf(!c.quantity.empty() && UnitsOf(c.quantity).empty(), "is",
             fmt::format("\"{}\" is no quantity; allowed time, rotor_angle, speed, and position_, "
                         "control_current_, excitation_, gap_, duty_towards_, duty_away_, "
                         "coil_current_towards_ or coil_current_away_ with a channel of the rig "
                         "behind it",
                         c.quantity));
}

void Describe(configuration::Visitor& v, ColumnMap& map) {
  v.Number(
      {"rate", configuration::unit::kHertz, 0, 1e9, 0.0, "sampling rate of a file without times"},
      map.rate_hz);
  v.List({"columns", 1, kMostColumns, "what each column of the file is"}, map.columns,
         [&v](MappedColumn& column, std::size_t) { Describe(v, column); });
}

/// "position_de_x_m" of position_de_x in mm, and what a cell is divided by to be in that.
struct OwnColumn {
  std::string name;
  double divisor{1.0};
};

OwnColumn OwnOf(const MappedColumn& column) {
  for (const MapQuantity& kind : Quantities()) {
    if (!Is(kind, column.quantity)) continue;
    const auto unit = std::ranges::find(kind.units, column.unit, &MapUnit::name);
    if (unit != kind.units.end()) return {column.quantity + std::string(kind.own), unit->divisor};
  }
  return {column.quantity};
}

std::optional<std::size_t> PlaceOf(const std::string& wanted,
                                   const std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, TrimmedName(wanted));
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  if (!wanted.starts_with('#') || wanted.size() > 6) return std::nullopt;
  std::size_t number = 0;
  for (const char digit : wanted.substr(1)) {
    if (digit < '0' || digit > '9') return std::nullopt;
    number = 10 * number + static_cast<std::size_t>(digit - '0');
  }
  if (number == 0 || number > names.size()) return std::nullopt;
  return number - 1;
}

std::string QuotedNames(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 40;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    text += fmt::format("{}\"{}\"", i > 0 ? ", " : "", names[i].substr(0, 100));
  }
  if (names.size() > kMost) text += fmt::format(" and {} more", names.size() - kMost);
  return text;
}

std::string NoSuchColumn(const std::string& wanted, const std::vector<std::string>& names) {
  const std::string near = LikelyMeant(wanted, names);
  return fmt::format("\n\"{}\" of the map is no column of the file{}", wanted,
                     near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
}

}  // namespace

std::string TrimmedName(std::string_view name) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '"'; };
  while (!name.empty() && blank(name.front())) name.remove_prefix(1);
  while (!name.empty() && blank(name.back())) name.remove_suffix(1);
  return std::string(name);
}

std::vector<std::string> UnitsOf(const std::string& quantity) {
  std::vector<std::string> units;
  for (const MapQuantity& kind : Quantities()) {
    if (!Is(kind, quantity)) continue;
    for (const MapUnit& unit : kind.units) units.emplace_back(unit.name);
  }
  return units;
}

ColumnMap ParseColumnMap(const std::string& text, const std::string& file_name) {
  return configuration::ReadAs<ColumnMap>(
      text, file_name, "import_map",
      [](configuration::Visitor& v, ColumnMap& map) { Describe(v, map); });
}

ColumnMap LoadColumnMap(const std::string& path) {
  return ParseColumnMap(configuration::ReadText(path), path);
}

CsvLayout ParseMappedColumns(const std::vector<std::string>& names, const ColumnMap& map,
                             const std::string& where, const std::vector<std::string>& channels) {
  std::vector<std::string> trimmed;
  for (const std::string& name : names) trimmed.push_back(TrimmedName(name));
  std::vector<std::string> own = trimmed;
  std::vector<const MappedColumn*> by(names.size(), nullptr);
  std::string problems;
  for (const MappedColumn& column : map.columns) {
    const auto place = PlaceOf(column.column, trimmed);
    if (!place) {
      problems += NoSuchColumn(column.column, trimmed);
    } else if (by[*place] != nullptr) {
      problems += fmt::format("\n\"{}\" is in the map twice", column.column);
    } else {
      by[*place] = &column;
      own[*place] = OwnOf(column).name;
    }
  }
  if (!problems.empty()) {
    throw BadInput(fmt::format("{}: its columns are {}{}", where, QuotedNames(trimmed), problems));
  }
  if (map.rate_hz > 0.0) {
    // The rate stands for the file's own times, which may be what is wrong with it.
    for (std::string& name : own) {
      if (name.starts_with("time_")) name = "#times";
    }
    own.emplace_back("time_s");
  }
  CsvLayout layout = ParseColumns(own, where, channels);
  for (std::size_t i = 0; i < names.size(); ++i) {
    layout.columns[i].name = trimmed[i];
    if (by[i] == nullptr) continue;
    layout.columns[i].divisor = OwnOf(*by[i]).divisor;
    layout.columns[i].factor = static_cast<double>(by[i]->sign) * by[i]->scale;
    layout.columns[i].offset = by[i]->offset;
  }
  return layout;
}

}  // namespace levitas::session
