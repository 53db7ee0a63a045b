#pragma once
// Rows of a measured CSV file in SI units, one after the other.
//
// Numbers  decimal point, or decimal comma where no comma separates the cells. A position may be
//          "nan" (a sensor that gave no number is data); a time or a current may not.
// Names    of the contract (csv_columns.hpp), or those that a map names (column_map.hpp). A row of
//          units below the names must agree with names of the contract; a map knows better.
// Failure  BadInput with line and column.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "common/axes.hpp"
#include "common/problem.hpp"
#include "session/exchange/column_map.hpp"
#include "session/exchange/csv_columns.hpp"
#include "session/exchange/csv_head.hpp"
#include "session/exchange/line_source.hpp"

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
  double bias_current_a{};                            ///< with a column of it
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
  /// `map` may be null.
  CsvRows(const std::string& path, const std::vector<std::string>& channels,
          const ColumnMap* map = nullptr);
  [[nodiscard]] const CsvLayout& layout() const noexcept override { return layout_; }
  /// Empty lines are skipped.
  bool Next(CsvRow& row) override;
  [[nodiscard]] BadInput Bad(const std::string& what) const override;

 private:
  double Number(std::size_t index);
  bool NextLine(std::string_view& line);
  void RefuseOtherUnits() const;

  std::string path_;
  LineSource lines_;
  CsvHead head_;
  CsvLayout layout_;
  std::size_t taken_ahead_{};
  std::uint64_t line_number_{};
  double rate_hz_{};  ///< 0: a column tells the time
  std::uint64_t rows_{};
  std::vector<std::string_view> cells_;
};

}  // namespace levitas::session
