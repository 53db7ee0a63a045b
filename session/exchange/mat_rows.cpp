#include "session/exchange/mat_rows.hpp"

#include <fmt/core.h>

#include <cmath>

#include "session/exchange/mat_file.hpp"

namespace levitas::session {

MatRows::MatRows(const std::string& path, const std::vector<std::string>& channels,
                 const std::string& matrix, const std::vector<std::string>& matrix_rows,
                 const ColumnMap* map)
    : path_(path), rate_hz_(map != nullptr ? map->rate_hz : 0.0) {
  MatTable table = ReadMat(path, matrix, matrix_rows);
  layout_ = map == nullptr ? ParseColumns(table.names, path, channels)
                           : ParseMappedColumns(table.names, *map, path, channels);
  columns_ = std::move(table.columns);
  std::size_t length = 0;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (layout_.columns[i].quantity == CsvQuantity::kIgnored) continue;
    if (length == 0) length = columns_[i].size();
    if (columns_[i].size() != length) {
      throw BadInput(fmt::format("{}: {} has {} samples, columns before it {}", path,
                                 layout_.columns[i].name, columns_[i].size(), length));
    }
  }
}

bool MatRows::Next(CsvRow& row) {
  const std::size_t sample = next_++;
  if (rate_hz_ > 0.0) row.time_s = static_cast<double>(sample) / rate_hz_;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const CsvColumn& column = layout_.columns[i];
    if (column.quantity == CsvQuantity::kIgnored) continue;
    if (sample >= columns_[i].size()) return false;
    const double value = columns_[i][sample];
    const bool place =
        column.quantity == CsvQuantity::kPosition || column.quantity == CsvQuantity::kGap;
    if (!std::isfinite(value) && !place) {
      throw Bad(fmt::format("{} is no finite number", column.name));
    }
    Put(column, value, row);
  }
  return true;
}

BadInput MatRows::Bad(const std::string& what) const {
  return BadInput(fmt::format("{}: sample {}: {}", path_, next_, what));
}

}  // namespace levitas::session
