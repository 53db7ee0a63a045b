#pragma once
// What the columns of somebody else's file are: `amb import --map`.
//
// Equation   quantity = sign × scale × (cell − offset), in the unit of the map; offset is what the
//            file shows where the quantity is zero, in the file's own numbers.
// Names      `column` is the name in the file, as it stands there; "#3" is the third one, of a file
//            without a line of names or with names that repeat. `is` names the quantity as a CSV
//            column of ours does, without its unit: time, rotor_angle, speed, position_de_x, ...
//            Columns that the map does not name are read by their own names (csv_columns.hpp).
// Time       from a column, or from `rate_hz`: then row n was sampled at n / rate_hz, and a column
//            of times that the file has is not read.
// Thread     any.
// Failure    BadInput with every problem of the map at once, and those of map and file together:
//            a column that the file does not have, with the names that it has.

#include <string>
#include <vector>

#include "session/exchange/csv_columns.hpp"

namespace levitas::session {

struct MappedColumn {
  std::string column;
  std::string quantity;
  std::string unit;
  int sign{1};
  double scale{1.0};
  double offset{};
};

struct ColumnMap {
  double rate_hz{};  ///< 0: a column tells the time
  std::vector<MappedColumn> columns;
};

[[nodiscard]] ColumnMap LoadColumnMap(const std::string& path);
[[nodiscard]] ColumnMap ParseColumnMap(const std::string& text, const std::string& file_name);

/// The layout of a file with these column names by the map; `where` begins a message. With
/// `rate_hz` the layout has a time as its last column, which the file does not have.
[[nodiscard]] CsvLayout ParseMappedColumns(const std::vector<std::string>& names,
                                           const ColumnMap& map, const std::string& where,
                                           const std::vector<std::string>& channels);

/// Units that a column of this quantity (of a map's `is`) may have; empty: no such quantity.
[[nodiscard]] std::vector<std::string> UnitsOf(const std::string& quantity);

/// A name as it is compared: without blanks and quotes around it.
[[nodiscard]] std::string TrimmedName(std::string_view name);

}  // namespace levitas::session
