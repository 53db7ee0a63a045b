#include "session/csv_rows.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>

#include "common/rotational_speed.hpp"

namespace levitas::session {
CsvRows::CsvRows(const std::string& path, const std::vector<std::string>& channels)
    : path_(path), lines_(path) {
  std::string_view line;
  if (!lines_.Next(line) || line.empty()) {
    throw BadInput(fmt::format("{}: line 1: no column names; the file is empty", path_));
  }
  layout_ = ParseCsvHeader(line, path_, channels);
}

bool CsvRows::Next(CsvRow& row) {
  std::string_view line;
  do {
    if (!lines_.Next(line)) return false;
  } while (line.find_first_not_of(" \t") == std::string_view::npos);
  SplitCsv(line, layout_.separator, cells_);
  if (cells_.size() != layout_.columns.size()) {
    throw Bad(fmt::format("{} cells, but line 1 names {} columns", cells_.size(),
                          layout_.columns.size()));
  }
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (layout_.columns[i].quantity != CsvQuantity::kIgnored) {
      Put(layout_.columns[i], Number(i), row);
    }
  }
  return true;
}

BadInput CsvRows::Bad(const std::string& what) const {
  return BadInput(fmt::format("{}: line {}: {}", path_, lines_.line_number(), what));
}

double CsvRows::Number(std::size_t index) {
  std::string_view cell = cells_[index];
  const CsvColumn& column = layout_.columns[index];
  // With semicolons between cells a comma is a decimal comma.
  if (layout_.separator == ';' && cell.find(',') != std::string_view::npos) {
    scratch_ = cell;
    scratch_[scratch_.find(',')] = '.';
    cell = scratch_;
  }
  // from_chars knows no leading plus; behind it a minus would be a second sign.
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool whole = end == cell.data() + cell.size() && !cell.empty();
  // A sensor that gave no number is data; a time or a current that is none is a broken file.
  const bool allowed = std::isfinite(value) || column.quantity == CsvQuantity::kPosition ||
                       column.quantity == CsvQuantity::kGap;
  if (error != std::errc{} || !whole || !allowed) {
    throw Bad(fmt::format("column {} ({}): found \"{}\", expected a {}number", index + 1,
                          column.name, cells_[index], whole ? "finite " : ""));
  }
  return value;
}

void Put(const CsvColumn& column, double in_unit, CsvRow& row) noexcept {
  const double value = in_unit / column.divisor;
  switch (column.quantity) {
    case CsvQuantity::kTime:
      row.time_s = value;
      return;
    case CsvQuantity::kAngle:
      row.angle_rad = value;
      return;
    case CsvQuantity::kSpeed:
      row.speed_rad_per_s = RpmToRadPerS(value);
      return;
    case CsvQuantity::kPosition:
      row.position_m[column.axis] = value;
      return;
    case CsvQuantity::kControlCurrent:
      row.control_current_a[column.axis] = value;
      return;
    case CsvQuantity::kExcitation:
      row.excitation_a[column.axis] = value;
      return;
    case CsvQuantity::kPositionExcitation:
      row.excitation_m[column.axis] = value;
      return;
    case CsvQuantity::kGap:
      row.gap_m[column.axis] = value;
      return;
    case CsvQuantity::kDutyTowards:
      row.duty_towards[column.axis] = value;
      return;
    case CsvQuantity::kDutyAway:
      row.duty_away[column.axis] = value;
      return;
    case CsvQuantity::kCoilTowards:
      row.coil_current_a[2 * column.axis] = value;
      return;
    case CsvQuantity::kCoilAway:
      row.coil_current_a[2 * column.axis + 1] = value;
      return;
    case CsvQuantity::kIgnored:
      return;
  }
}

}  // namespace levitas::session
