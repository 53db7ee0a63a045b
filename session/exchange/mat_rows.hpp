#pragma once
// Rows of a MAT file (MATLAB, Octave, SciPy; version 4, 5 or 7.3) in SI units.
//
// Layout    either a vector for every column, named as the columns of a CSV file are
//           (csv_columns.hpp), all equally long; or one matrix with a quantity a row (or a column,
//           when that fits), whose names the rig file gives. Names beginning with "ignored" are
//           left out. Other variables of the file are ignored and listed.
// Numbers   real, in any of MATLAB's number types. A position may be NaN, nothing else.
// Failure   BadInput naming the variable.
// Thread    any.

#include <string>
#include <vector>

#include "session/exchange/csv_rows.hpp"

namespace levitas::session {

class MatRows : public RowSource {
 public:
  /// Without `matrix` only vectors are looked for; `map` may be null.
  MatRows(const std::string& path, const std::vector<std::string>& channels,
          const std::string& matrix, const std::vector<std::string>& matrix_rows,
          const ColumnMap* map = nullptr);
  [[nodiscard]] const CsvLayout& layout() const noexcept override { return layout_; }
  bool Next(CsvRow& row) override;
  [[nodiscard]] BadInput Bad(const std::string& what) const override;

 private:
  std::string path_;
  CsvLayout layout_;
  std::vector<std::vector<double>> columns_;
  std::size_t next_{0};
  double rate_hz_{};  ///< 0: a column tells the time
};

}  // namespace levitas::session
