#pragma once
// What a probe reads while a positioning platform carries its target along the axis: a CSV file of
// two columns, row after row as it was measured.
//
// Names    displacement_<m|mm|um|nm> of the platform and reading_<m|mm|um|nm|v|mv> of the probe; or
//          displacement and reading above a row of units, lengths only. Others are ignored.
//          Comments, separators, decimal commas and .xz are as in session/exchange/csv_head.hpp.
// Order    of the rows is that of the measurement: it tells which way the platform went. Places may
//          be repeated and visited from both sides.
// Sign     both columns along the axis of the bearing.
// Thread   any. Failure: BadInput naming file, line, what was found and what is allowed: a column
//          or a unit that is missing, a cell that is no finite number, fewer than kLeastRows rows.

#include <string>
#include <vector>

namespace levitas::identification {

struct PlatformTable {
  static constexpr std::size_t kLeastRows = 8;

  std::vector<double> displacement_m;
  std::vector<double> reading;  ///< m, or V
  bool volts{};

  [[nodiscard]] std::size_t rows() const noexcept { return displacement_m.size(); }
};

[[nodiscard]] PlatformTable ReadPlatformTable(const std::string& path);

}  // namespace levitas::identification
