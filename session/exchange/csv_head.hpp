#pragma once
// The beginning of a text file of measured rows: which line names the columns, whether a row of
// units follows, and what parts the cells.
//
// Names      the first line that has a name `known` accepts, also behind a comment sign; else the
//            line above the first row of numbers that has as many cells; else none, and the columns
//            are "#1", "#2", ...
// Left out   before and behind the names: empty lines, comments (#, %, //) and "sep=;".
// Units      a row below the names whose cells are all units, in brackets or not.
// Bounds     the names are looked for in the first kMostHeadLines lines, of kMostHeadBytes at most.
// Thread     any.
// Failure    BadInput of the line source; of a file without a line that is not left out.

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "session/exchange/line_source.hpp"

namespace levitas::session {

inline constexpr std::size_t kMostHeadLines = 200;
inline constexpr std::size_t kMostHeadBytes = std::size_t{2} << 20;

/// A line that was read on the way and belongs to the rows, with its number.
using NumberedLine = std::pair<std::uint64_t, std::string>;

struct CsvHead {
  char separator{','};
  std::uint64_t line{};  ///< of the names, from 1; 0: the file has none
  std::vector<std::string> names;
  std::vector<std::string> units;  ///< one per name, as UnitWord has it; empty: no such row
  std::vector<NumberedLine> ahead;
};

[[nodiscard]] CsvHead ReadCsvHead(LineSource& lines, const std::string& path,
                                  const std::function<bool(const std::string&)>& known);

/// Whether a line is left out: empty, a comment, "sep=;".
[[nodiscard]] bool IsNoRow(std::string_view line);

/// "um" of "[µm]", "rpm" of "1/min", "deg" of "°": the unit as names and maps of columns have it;
/// empty when it is none of theirs.
[[nodiscard]] std::string UnitWord(std::string_view cell);

/// A number with the decimal sign that goes with the separator; false: the cell is none.
[[nodiscard]] bool ParseCell(std::string_view cell, char separator, double& value);

}  // namespace levitas::session
