#pragma once
// Rows of a measured CSV file in SI units, one after the other.
//
// Numbers  decimal point, or decimal comma when semicolons separate the cells. A position may be
//          "nan" (a sensor that gave no number is data); a time or a current may not.
// Failure  BadInput with line and column.

#include <array>
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
  AxisArray gap_m{};
  AxisArray duty_towards{};
  AxisArray duty_away{};
  std::array<double, 2 * kMaxAxes> coil_current_a{};  ///< towards + and away, axis by axis
};

/// Rows of measured data, from whatever kind of file.
class RowSource {
 public:
  virtual ~RowSource() = default;
  [[nodiscard]] virtual const CsvLayout& layout() const noexcept = 0;
  /// False at the end.
  virtual bool Next(CsvRow& row) = 0;
  /// A problem of the row last read.
  [[nodiscard]] virtual BadInput Bad(const std::string& what) const = 0;
};

/// A value in the unit of its column, into the field of the row that it belongs to.
void Put(const CsvColumn& column, double value, CsvRow& row) noexcept;

class CsvRows : public RowSource {
 public:
  CsvRows(const std::string& path, const std::vector<std::string>& channels);
  [[nodiscard]] const CsvLayout& layout() const noexcept override { return layout_; }
  /// Empty lines are skipped.
  bool Next(CsvRow& row) override;
  [[nodiscard]] BadInput Bad(const std::string& what) const override;

 private:
  double Number(std::size_t index);

  std::string path_;
  LineSource lines_;
  CsvLayout layout_;
  std::vector<std::string_view> cells_;
  std::string scratch_;
};

}  // namespace levitas::session
