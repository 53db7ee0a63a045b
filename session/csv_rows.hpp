#pragma once
// Rows of a measured CSV file in SI units, one after the other.
//
// Numbers  decimal point, or decimal comma when semicolons separate the cells. A position may be
//          "nan" (a sensor that gave no number is data); a time or a current may not.
// Failure  BadInput with line and column.

#include <string>
#include <string_view>
#include <vector>

#include "common/axes.hpp"
#include "common/problem.hpp"
#include "session/csv_columns.hpp"
#include "session/line_source.hpp"

namespace levitas::session {

struct CsvRow {
  double time_s{};
  double angle_rad{};
  double speed_rad_per_s{};
  AxisArray position_m{};
  AxisArray control_current_a{};
  AxisArray excitation_a{};
  AxisArray excitation_m{};
};

class CsvRows {
 public:
  CsvRows(const std::string& path, const std::vector<std::string>& channels);
  [[nodiscard]] const CsvLayout& layout() const noexcept { return layout_; }
  /// False at the end. Empty lines are skipped.
  bool Next(CsvRow& row);
  /// A problem of the line last read.
  [[nodiscard]] BadInput Bad(const std::string& what) const;

 private:
  double Number(std::size_t index);
  void Put(std::size_t index, CsvRow& row);

  std::string path_;
  LineSource lines_;
  CsvLayout layout_;
  std::vector<std::string_view> cells_;
  std::string scratch_;
};

}  // namespace levitas::session
