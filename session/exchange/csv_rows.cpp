#include "session/exchange/csv_rows.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/rotational_speed.hpp"
#include "session/exchange/file_kind.hpp"

namespace levitas::session {
namespace {

std::function<bool(const std::string&)> KnownBy(const ColumnMap* map) {
  return [map](const std::string& name) {
    if (map == nullptr) return IsNameOfOurs(name);
    return std::ranges::any_of(map->columns, [&name](const MappedColumn& column) {
      return TrimmedName(column.column) == TrimmedName(name);
    });
  };
}

/// `path`, unless the file is of another kind than text.
const std::string& Text(const std::string& path) {
  RefuseOtherKind(path);
  return path;
}

std::string WhereOf(const std::string& path, const CsvHead& head) {
  if (head.line > 0) return fmt::format("{}: line {}", path, head.line);
  return path + ": no line names the columns, which are counted";
}

/// Null for a column that is ignored.
double* NumberIn(CsvRow& row, const CsvColumn& column) noexcept {
  switch (column.quantity) {
    case CsvQuantity::kTime:
      return &row.time_s;
    case CsvQuantity::kAngle:
      return &row.angle_rad;
    case CsvQuantity::kSpeed:
      return &row.speed_rad_per_s;
    case CsvQuantity::kPosition:
      return &row.position_m[column.axis];
    case CsvQuantity::kControlCurrent:
      return &row.control_current_a[column.axis];
    case CsvQuantity::kExcitation:
      return &row.excitation_a[column.axis];
    case CsvQuantity::kPositionExcitation:
      return &row.excitation_m[column.axis];
    case CsvQuantity::kGap:
      return &row.gap_m[column.axis];
    case CsvQuantity::kDutyTowards:
      return &row.duty_towards[column.axis];
    case CsvQuantity::kDutyAway:
      return &row.duty_away[column.axis];
    case CsvQuantity::kCoilTowards:
      return &row.coil_current_a[2 * column.axis];
    case CsvQuantity::kCoilAway:
      return &row.coil_current_a[2 * column.axis + 1];
    case CsvQuantity::kBias:
      return &row.bias_current_a;
    case CsvQuantity::kIgnored:
      break;
  }
  return nullptr;
}

}  // namespace

CsvRows::CsvRows(const std::string& path, const std::vector<std::string>& channels,
                 const ColumnMap* map)
    : path_(path), lines_(Text(path)), head_(ReadCsvHead(lines_, path, KnownBy(map))) {
  if (map == nullptr) {
    layout_ = ParseColumns(head_.names, WhereOf(path, head_), channels);
    RefuseOtherUnits();
  } else {
    layout_ = ParseMappedColumns(head_.names, *map, WhereOf(path, head_), channels);
    rate_hz_ = map->rate_hz;
  }
  layout_.separator = head_.separator;
}

void CsvRows::RefuseOtherUnits() const {
  for (std::size_t i = 0; i < head_.units.size(); ++i) {
    const CsvColumn& column = layout_.columns[i];
    if (column.quantity == CsvQuantity::kIgnored || head_.units[i].empty()) continue;
    if (column.name.ends_with("_" + head_.units[i])) continue;
    throw BadInput(fmt::format(
        "{}: line {} names column {} {}, the row of units below says {}: rename the column, or map "
        "it (amb import --map)",
        path_, head_.line, i + 1, column.name, head_.units[i]));
  }
}

bool CsvRows::NextLine(std::string_view& line) {
  if (taken_ahead_ < head_.ahead.size()) {
    line_number_ = head_.ahead[taken_ahead_].first;
    line = head_.ahead[taken_ahead_++].second;
    return true;
  }
  if (!lines_.Next(line)) return false;
  line_number_ = lines_.line_number();
  return true;
}

bool CsvRows::Next(CsvRow& row) {
  std::string_view line;
  do {
    if (!NextLine(line)) return false;
  } while (IsNoRow(line));
  SplitCsv(line, layout_.separator, cells_);
  if (cells_.size() != head_.names.size()) {
    throw Bad(fmt::format("{} cells, but line {} names {} columns", cells_.size(), head_.line,
                          head_.names.size()));
  }
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (layout_.columns[i].quantity != CsvQuantity::kIgnored) {
      Put(layout_.columns[i], Number(i), row);
    }
  }
  if (rate_hz_ > 0.0) row.time_s = static_cast<double>(rows_) / rate_hz_;
  ++rows_;
  return true;
}

BadInput CsvRows::Bad(const std::string& what) const {
  return BadInput(fmt::format("{}: line {}: {}", path_, line_number_, what));
}

double CsvRows::Number(std::size_t index) {
  const CsvColumn& column = layout_.columns[index];
  double value = 0.0;
  const bool whole = ParseCell(cells_[index], layout_.separator, value);
  // A sensor that gave no number is data; a time or a current that is none is a broken file.
  const bool allowed = std::isfinite(value) || column.quantity == CsvQuantity::kPosition ||
                       column.quantity == CsvQuantity::kGap;
  if (!whole || !allowed) {
    throw Bad(fmt::format("column {} ({}): found \"{}\", expected a {}number", index + 1,
                          column.name, cells_[index], whole ? "finite " : ""));
  }
  return value;
}

void Put(const CsvColumn& column, double in_unit, CsvRow& row) noexcept {
  double* const number = NumberIn(row, column);
  if (number == nullptr) return;
  const double value = column.factor * (in_unit - column.offset) / column.divisor;
  *number = column.quantity == CsvQuantity::kSpeed ? RpmToRadPerS(value) : value;
}

}  // namespace levitas::session
