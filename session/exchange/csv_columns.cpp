#include "session/exchange/csv_columns.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <set>

#include "common/nearest.hpp"
#include "common/problem.hpp"

namespace levitas::session {
namespace {

struct Unit {
  std::string_view name;
  double divisor;
};
constexpr std::array<Unit, 3> kLengths{{{"m", 1.0}, {"mm", 1e3}, {"um", 1e6}}};
constexpr std::array<Unit, 2> kCurrents{{{"a", 1.0}, {"ma", 1e3}}};

enum class Kind : std::uint8_t { kLength, kCurrent, kShare };

struct PerAxis {
  CsvQuantity quantity;
  std::string_view prefix;
  Kind kind;
  CsvQuantity instead{CsvQuantity::kIgnored};  ///< needed, unless this one is there
};
constexpr std::array<PerAxis, 9> kPerAxis{
    {{CsvQuantity::kPosition, "position_", Kind::kLength, CsvQuantity::kGap},
     {CsvQuantity::kControlCurrent, "control_current_", Kind::kCurrent, CsvQuantity::kDutyTowards},
     {CsvQuantity::kExcitation, "excitation_", Kind::kCurrent},
     {CsvQuantity::kPositionExcitation, "excitation_", Kind::kLength},
     {CsvQuantity::kGap, "gap_", Kind::kLength},
     {CsvQuantity::kDutyTowards, "duty_towards_", Kind::kShare},
     {CsvQuantity::kDutyAway, "duty_away_", Kind::kShare},
     {CsvQuantity::kCoilTowards, "coil_current_towards_", Kind::kCurrent},
     {CsvQuantity::kCoilAway, "coil_current_away_", Kind::kCurrent}}};

/// Every name that is understood, and what it means.
std::vector<CsvColumn> KnownColumns(const std::vector<std::string>& channels) {
  constexpr double kDegree = 180.0 / std::numbers::pi;
  std::vector<CsvColumn> known{{CsvQuantity::kTime, 0, 1.0, "time_s"},
                               {CsvQuantity::kTime, 0, 1e3, "time_ms"},
                               {CsvQuantity::kTime, 0, 1e6, "time_us"},
                               {CsvQuantity::kAngle, 0, 1.0, "rotor_angle_rad"},
                               {CsvQuantity::kAngle, 0, kDegree, "rotor_angle_deg"},
                               {CsvQuantity::kSpeed, 0, 1.0, "speed_rpm"},
                               {CsvQuantity::kSpeed, 0, 1.0 / 60.0, "speed_hz"},
                               {CsvQuantity::kBias, 0, 1.0, "bias_current_a"},
                               {CsvQuantity::kBias, 0, 1e3, "bias_current_ma"}};
  const auto add = [&](const PerAxis& kind, std::size_t axis, const Unit& unit) {
    known.push_back({kind.quantity, axis, unit.divisor,
                     fmt::format("{}{}{}{}", kind.prefix, channels[axis],
                                 unit.name.empty() ? "" : "_", unit.name)});
  };
  for (const PerAxis& kind : kPerAxis) {
    for (std::size_t axis = 0; axis < channels.size(); ++axis) {
      switch (kind.kind) {
        case Kind::kLength:
          for (const Unit& unit : kLengths) add(kind, axis, unit);
          break;
        case Kind::kCurrent:
          for (const Unit& unit : kCurrents) add(kind, axis, unit);
          break;
        case Kind::kShare:
          add(kind, axis, {"", 1.0});
          break;
      }
    }
  }
  return known;
}

// No name of ours is nearly as long; of a longer one the beginning is looked at, so that a line of
// one long word costs no more than a line of many.
constexpr std::size_t kLongestName = 100;
std::string_view Beginning(std::string_view name) { return name.substr(0, kLongestName); }

/// Errors that make a name of ours unknown: a letter or two.
constexpr std::size_t kTypingErrors = 2;
/// So many unknown names are looked at: a table of another program has thousands.
constexpr std::size_t kMostComplaints = 20;

/// Names of columns have no capitals, so a capital is no error to be counted.
std::string Lower(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return lower;
}

bool HasPrefixOfOurs(std::string_view name) {
  return std::any_of(kPerAxis.begin(), kPerAxis.end(),
                     [&](const PerAxis& kind) { return name.starts_with(kind.prefix); });
}

/// The nearest of at most `most` errors; null: there is none.
const CsvColumn* Nearest(std::string_view name, const std::vector<CsvColumn>& known,
                         std::size_t most) {
  const CsvColumn* nearest = nullptr;
  std::size_t least = most + 1;
  for (const CsvColumn& column : known) {
    const std::size_t longer = std::max(name.size(), column.name.size());
    // As many errors at least as one is longer than the other.
    if (2 * longer - name.size() - column.name.size() >= least) continue;
    const std::size_t distance = EditDistance(name, column.name);
    if (distance >= least) continue;
    nearest = &column;
    least = distance;
  }
  return nearest;
}

/// Which column an unknown name was probably meant to be; null: none of ours.
const CsvColumn* ColumnMeant(std::string_view name, const std::vector<CsvColumn>& known) {
  const std::string lower = Lower(name);
  return Nearest(lower, known, HasPrefixOfOurs(lower) ? kLongestName : kTypingErrors);
}

std::vector<std::string> Missing(const CsvLayout& layout,
                                 const std::vector<std::string>& channels) {
  std::vector<std::string> missing;
  if (!layout.Has(CsvQuantity::kTime)) missing.emplace_back("time_s");
  for (const PerAxis& kind : kPerAxis) {
    const bool needed = kind.instead != CsvQuantity::kIgnored;
    for (std::size_t axis = 0; needed && axis < channels.size(); ++axis) {
      const auto holds = [&](const CsvColumn& column) {
        return column.axis == axis &&
               (column.quantity == kind.quantity || column.quantity == kind.instead);
      };
      if (std::none_of(layout.columns.begin(), layout.columns.end(), holds)) {
        missing.push_back(fmt::format("{}{}_{}", kind.prefix, channels[axis],
                                      kind.kind == Kind::kLength ? "m (or mm, um)" : "a (or ma)"));
      }
    }
  }
  return missing;
}

/// Channels that columns are named for, "de_x" of "position_de_x_um".
std::vector<std::string> ChannelsOf(const std::vector<std::string>& cells) {
  std::vector<std::string> found;
  for (const std::string& cell : cells) {
    const auto unit = cell.rfind('_');
    for (const std::string_view prefix : {"position_", "gap_"}) {
      if (!cell.starts_with(prefix) || unit == std::string::npos || unit <= prefix.size()) continue;
      found.push_back(cell.substr(prefix.size(), unit - prefix.size()));
    }
  }
  return found;
}

/// What is there instead, and what helps.
std::string Found(const std::vector<std::string>& cells) {
  constexpr std::size_t kMost = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(cells.size(), kMost); ++i) {
    text += fmt::format("{}\"{}\"", i > 0 ? ", " : "", Beginning(cells[i]));
  }
  if (cells.size() > kMost) text += fmt::format(" and {} more", cells.size() - kMost);
  return "\ncolumns found: " + text +
         "\nrename them, or map them: amb import with --guess prints a map of what each probably "
         "is, "
         "--map takes it";
}

void RefuseTooManyColumns(std::size_t count, const std::string& where) {
  if (count > kMostColumns) {
    throw BadInput(
        fmt::format("{}: has {} columns, at most {} are allowed: leave out what is not "
                    "of the rig",
                    where, count, kMostColumns));
  }
}

void RefuseProblems(const std::vector<std::string>& problems, const std::string& where) {
  if (problems.empty()) return;
  std::string text;
  for (const auto& problem : problems) text += (text.empty() ? "" : "\n") + problem;
  throw BadInput(fmt::format("{}: {}", where, text));
}

/// None of the channels is the rig's: one sentence says more than a line for every column.
void RefuseOtherRig(const std::vector<std::string>& cells, const std::string& where,
                    const std::vector<std::string>& channels) {
  const std::vector<std::string> found = ChannelsOf(cells);
  const bool none = std::none_of(found.begin(), found.end(), [&](const std::string& channel) {
    return std::find(channels.begin(), channels.end(), channel) != channels.end();
  });
  if (found.empty() || !none) return;
  throw BadInput(fmt::format(
      "{}: the columns are of the channels {}, the rig has {}: name the rig of these data with "
      "--rig",
      where, Listed(found), Listed(channels)));
}

}  // namespace

bool IsNameOfOurs(std::string_view name) {
  return name.starts_with("time_") || name.starts_with("rotor_angle_") ||
         name.starts_with("speed_") || HasPrefixOfOurs(name);
}

namespace {

bool IsNumeral(char c) { return c >= '0' && c <= '9'; }

/// Every comma stands within a number: 0,5 or -,5.
bool CommasAreDecimal(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != ',') continue;
    const bool behind = i + 1 < line.size() && IsNumeral(line[i + 1]);
    const bool before = i == 0 || IsNumeral(line[i - 1]) || line[i - 1] == '-' ||
                        line[i - 1] == '+' || line[i - 1] == ';' || line[i - 1] == ' ';
    if (!behind || !before) return false;
  }
  return true;
}

}  // namespace

char SeparatorOf(std::string_view line) {
  const auto count = [line](char c) { return std::count(line.begin(), line.end(), c); };
  const auto tabs = count('\t');
  const auto semicolons = count(';');
  const auto commas = count(',');
  if (tabs > 0 && tabs >= semicolons && tabs >= commas) return '\t';
  // A row of decimal commas may have more of them than of what parts its cells.
  if (semicolons > 0 && CommasAreDecimal(line)) return ';';
  if (semicolons + commas > 0) return semicolons > commas ? ';' : ',';
  return line.find(' ') != std::string_view::npos ? ' ' : ',';
}

bool CsvLayout::Has(CsvQuantity quantity) const noexcept {
  return std::any_of(columns.begin(), columns.end(),
                     [&](const CsvColumn& column) { return column.quantity == quantity; });
}

void SplitCsv(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  for (std::size_t start = 0; start <= line.size();) {
    if (separator == ' ') {
      start = std::min(line.find_first_not_of(' ', start), line.size());
      if (start == line.size() && !cells.empty()) return;
    }
    const std::size_t end = std::min(line.find(separator, start), line.size());
    std::string_view cell = line.substr(start, end - start);
    const auto blank = [](char c) { return c == ' ' || c == '\t'; };
    while (!cell.empty() && blank(cell.front())) cell.remove_prefix(1);
    while (!cell.empty() && blank(cell.back())) cell.remove_suffix(1);
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
      cell = cell.substr(1, cell.size() - 2);
    }
    cells.push_back(cell);
    start = end + 1;
  }
}

CsvLayout ParseColumns(const std::vector<std::string>& cells, const std::string& where,
                       const std::vector<std::string>& channels) {
  RefuseTooManyColumns(cells.size(), where);
  RefuseOtherRig(cells, where, channels);
  CsvLayout layout;
  const std::vector<CsvColumn> known = KnownColumns(channels);
  std::vector<std::string> problems;
  std::size_t not_looked_at = 0;
  std::set<std::pair<CsvQuantity, std::size_t>> seen;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string& name = cells[i];
    const auto is_it = [&](const CsvColumn& column) { return column.name == name; };
    const auto found = std::find_if(known.begin(), known.end(), is_it);
    if (found == known.end()) {
      const bool looked_at = problems.size() < kMostComplaints;
      if (!looked_at) ++not_looked_at;
      const CsvColumn* meant = looked_at ? ColumnMeant(Beginning(name), known) : nullptr;
      if (meant != nullptr) {
        problems.push_back(
            fmt::format("column {} \"{}\" is not known (channels of the rig: {}); "
                        "did you mean \"{}\"?",
                        i + 1, Beginning(name), Listed(channels), meant->name));
      }
      layout.ignored.push_back(name);
      layout.columns.push_back({CsvQuantity::kIgnored, 0, 1.0, name});
      continue;
    }
    if (!seen.insert({found->quantity, found->axis}).second) {
      problems.push_back(fmt::format("column {} \"{}\" is given twice", i + 1, name));
    }
    layout.columns.push_back(*found);
  }
  if (not_looked_at > 0) {
    problems.push_back(fmt::format("{} more unknown columns were not compared with the names known",
                                   not_looked_at));
  }
  const auto missing = Missing(layout, channels);
  if (!missing.empty()) problems.push_back("columns missing: " + Listed(missing) + Found(cells));
  RefuseProblems(problems, where);
  return layout;
}

}  // namespace levitas::session
