#include "identification/probe/platform_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "common/problem.hpp"
#include "session/exchange/csv_columns.hpp"
#include "session/exchange/csv_head.hpp"
#include "session/exchange/line_source.hpp"

namespace levitas::identification {
namespace {

struct ProbeUnit {
  std::string_view word;
  double si;
  bool volts;
};
constexpr std::array<ProbeUnit, 6> kProbeUnits{{{"m", 1.0, false},
                                                {"mm", 1e-3, false},
                                                {"um", 1e-6, false},
                                                {"nm", 1e-9, false},
                                                {"v", 1.0, true},
                                                {"mv", 1e-3, true}}};

struct TableColumn {
  std::size_t at{};
  std::string name;
  ProbeUnit unit{};
};

bool IsTableName(const std::string& name) {
  return name.starts_with("displacement") || name.starts_with("reading");
}

const ProbeUnit* UnitOf(const std::string& word, bool length) {
  for (const ProbeUnit& unit : kProbeUnits) {
    if (unit.word == word && !(length && unit.volts)) return &unit;
  }
  return nullptr;
}

/// The one column of `quantity`, by its name or by a row of units.
TableColumn ColumnOf(const std::string& quantity, const session::CsvHead& head,
                     const std::string& path) {
  const bool length = quantity == "displacement";
  const std::string allowed = fmt::format("{}_<m|mm|um|nm{}>", quantity, length ? "" : "|v|mv");
  const std::string where = head.line > 0 ? fmt::format("{}: line {}", path, head.line)
                                          : fmt::format("{}: no line of names", path);
  const std::string* named = nullptr;
  for (std::size_t at = 0; at < head.names.size(); ++at) {
    const std::string& name = head.names[at];
    if (!name.starts_with(quantity)) continue;
    if (named != nullptr) {
      throw BadInput(fmt::format("{}: two columns of one quantity, '{}' and '{}'; allowed: one {}",
                                 where, *named, name, allowed));
    }
    named = &name;
  }
  if (named == nullptr) {
    throw BadInput(fmt::format("{}: no column '{}'; there are: {}. A table needs {} and {}", where,
                               allowed, fmt::join(head.names, ", "), "displacement_<unit>",
                               "reading_<unit>"));
  }
  const auto at = static_cast<std::size_t>(named - head.names.data());
  std::string word;
  if (named->size() > quantity.size() + 1) word = named->substr(quantity.size() + 1);
  if (word.empty() && at < head.units.size()) word = head.units[at];
  const ProbeUnit* unit = UnitOf(word, length);
  if (unit == nullptr) {
    throw BadInput(fmt::format("{}: column '{}' has {}; allowed: {}", where, *named,
                               word.empty() ? "no unit" : "the unit '" + word + "'", allowed));
  }
  return {at, *named, *unit};
}

double ValueOf(const TableColumn& column, const std::vector<std::string_view>& cells,
               char separator, const std::string& where) {
  if (column.at >= cells.size()) {
    throw BadInput(fmt::format("{}: {} cells, column '{}' is number {}", where, cells.size(),
                               column.name, column.at + 1));
  }
  double value = 0.0;
  if (!session::ParseCell(cells[column.at], separator, value) || !std::isfinite(value)) {
    throw BadInput(fmt::format("{}: column '{}': '{}' is no finite number; leave the row out",
                               where, column.name, cells[column.at]));
  }
  return value * column.unit.si;
}

}  // namespace

PlatformTable ReadPlatformTable(const std::string& path) {
  session::LineSource lines(path);
  const session::CsvHead head = session::ReadCsvHead(lines, path, IsTableName);
  const TableColumn displacement = ColumnOf("displacement", head, path);
  const TableColumn reading = ColumnOf("reading", head, path);
  PlatformTable table{{}, {}, reading.unit.volts};
  std::vector<std::string_view> cells;
  const auto take = [&](std::string_view line, std::uint64_t number) {
    if (session::IsNoRow(line)) return;
    session::SplitCsv(line, head.separator, cells);
    const std::string where = fmt::format("{}: line {}", path, number);
    table.displacement_m.push_back(ValueOf(displacement, cells, head.separator, where));
    table.reading.push_back(ValueOf(reading, cells, head.separator, where));
  };
  for (const auto& [number, line] : head.ahead) take(line, number);
  std::string_view line;
  while (lines.Next(line)) take(line, lines.line_number());
  if (table.rows() < PlatformTable::kLeastRows) {
    throw BadInput(fmt::format("{}: {} rows; a characteristic needs {} at least", path,
                               table.rows(), PlatformTable::kLeastRows));
  }
  return table;
}

}  // namespace levitas::identification
