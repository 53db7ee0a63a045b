#pragma once
// Sampled inputs and outputs of any system, as the nonlinear identification methods take them.
//
// Rows     one per sample, evenly spaced; nothing is said about units: a column has the unit of its
//          file, and models of it have too.
// Thread   any.
// Failure  BadInput: a column that is not there, a cell that is no number, no rows, a range that
//          does not lie in the file.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "session/exchange/recording.hpp"

namespace levitas::identification {

struct Series {
  double period_s{};
  std::vector<std::string> input_names, output_names;
  Eigen::MatrixXd input;   ///< rows x inputs
  Eigen::MatrixXd output;  ///< rows x outputs

  [[nodiscard]] Eigen::Index rows() const noexcept { return output.rows(); }
  [[nodiscard]] Eigen::Index inputs() const noexcept { return input.cols(); }
  [[nodiscard]] Eigen::Index outputs() const noexcept { return output.cols(); }
};

/// Rows begin .. end - 1.
struct RowRange {
  std::size_t begin{}, end{};
};

/// "100:40575"; an open end ("100:") is the last row. BadInput when it is none or empty.
[[nodiscard]] RowRange ParseRange(const std::string& text, std::size_t rows);

[[nodiscard]] Series Slice(const Series& series, const RowRange& range);

struct SeriesColumns {
  std::vector<std::string> inputs, outputs;
};

/// Named columns of a CSV file (.csv, .csv.xz). The sampling period is the mean step of a column
/// time_s when there is one, else `period_s`; neither given is refused.
[[nodiscard]] Series ReadSeries(const std::string& path, const SeriesColumns& columns,
                                double period_s);

/// The same from a record: position_<channel>, control_current_<channel>, excitation_<channel>,
/// in SI units.
[[nodiscard]] Series SeriesOf(const session::Recording& record, const SeriesColumns& columns);

/// One sentence when no model can come of it: a dead or clipped column, values that are no numbers,
/// an input that never changes, too few rows for `unknowns`.
void RefuseUnfit(const Series& series, std::size_t unknowns);

}  // namespace levitas::identification
