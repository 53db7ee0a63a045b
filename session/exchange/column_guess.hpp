#pragma once
// What the columns of somebody else's file probably are: `amb import --guess`, a map of columns for
// a person to confirm (column_map.hpp).
//
// From       names (words and letters of their language: pos, x, A, 1, strom, rpm), units in the
//            name or in a row below, and the first kGuessRows rows: a length or a current without a
//            unit has the one that fits the sensors' range or the coils' limit, a time the one that
//            fits the rig's period.
// Not done   signs and offsets: nothing in a file tells them.
// Thread     any.
// Failure    BadInput: as reading the file does.

#include <string>
#include <vector>

#include "common/rig_numbers.hpp"

namespace levitas::session {

inline constexpr std::size_t kGuessRows = 2000;

struct GuessedColumn {
  std::string column;    ///< name in the file
  std::string quantity;  ///< as a map's `is`; empty: not understood
  std::string unit;
  bool unit_by_values{};  ///< the file does not say it
  double low{}, high{};   ///< of the rows looked at; NaN: no numbers
};

struct ColumnGuess {
  std::vector<GuessedColumn> columns;
  std::vector<std::string> missing;  ///< quantities that a record needs
  double periods_a_row{};            ///< of the rig, in the median; 0: not known
};

/// Names, units (empty: none) and numbers, column by column.
struct SampledColumns {
  std::vector<std::string> names;
  std::vector<std::string> units;
  std::vector<std::vector<double>> values;
};

/// Of a text file.
[[nodiscard]] SampledColumns SampleColumns(const std::string& path);
/// Of the vectors of a MAT file, or of the matrix that the rig names.
[[nodiscard]] SampledColumns SampleMat(const std::string& path, const std::string& matrix,
                                       const std::vector<std::string>& matrix_rows);
[[nodiscard]] ColumnGuess GuessColumns(const SampledColumns& file, const RigNumbers& rig);

/// The map as text, with what was seen and what is missing as comments; `import` is the command
/// that takes it.
[[nodiscard]] std::string GuessText(const ColumnGuess& guess, const RigNumbers& rig,
                                    const std::string& data_path, const std::string& import);

}  // namespace levitas::session
