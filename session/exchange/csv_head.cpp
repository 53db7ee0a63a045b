#include "session/exchange/csv_head.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "common/problem.hpp"
#include "session/exchange/csv_columns.hpp"

namespace levitas::session {
namespace {

constexpr std::array<std::string_view, 3> kCommentSigns{"#", "%", "//"};

std::string_view Bare(std::string_view text, std::string_view around) {
  while (!text.empty() && around.find(text.front()) != std::string_view::npos) {
    text.remove_prefix(1);
  }
  while (!text.empty() && around.find(text.back()) != std::string_view::npos) text.remove_suffix(1);
  return text;
}

bool IsComment(std::string_view line) {
  const std::string_view bare = Bare(line, " \t\"");
  return std::ranges::any_of(kCommentSigns,
                             [bare](std::string_view sign) { return bare.starts_with(sign); });
}

/// A line without its comment sign.
std::string_view Uncommented(std::string_view line) {
  return IsComment(line) ? Bare(line, " \t\"#%/") : line;
}

std::vector<std::string> CellsOf(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  SplitCsv(line, separator, cells);
  return {cells.begin(), cells.end()};
}

bool IsNumeric(std::string_view line) {
  const char separator = SeparatorOf(line);
  std::size_t count = 0;
  for (const std::string& cell : CellsOf(line, separator)) {
    double value = 0.0;
    if (!cell.empty() && !ParseCell(cell, separator, value)) return false;
    if (!cell.empty()) ++count;
  }
  return count > 0;
}

/// Words of a row of units that no column of ours has.
bool IsForeignUnit(std::string_view cell) {
  constexpr std::array<std::string_view, 12> kForeign{"",  "-",  "1", "v",    "mv", "n",
                                                      "g", "°c", "c", "m/s²", "w",  "none"};
  std::string lower(cell);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  const bool bracketed = cell.size() > 2 && (cell.front() == '[' || cell.front() == '(');
  return bracketed || std::ranges::find(kForeign, lower) != kForeign.end();
}

std::vector<std::string> UnitsOfRow(std::string_view line, char separator, std::size_t columns) {
  const auto cells = CellsOf(line, separator);
  if (cells.size() != columns) return {};
  std::vector<std::string> units;
  bool any = false;
  for (const std::string& cell : cells) {
    units.push_back(UnitWord(cell));
    if (units.back().empty() && !IsForeignUnit(cell)) return {};
    any = any || !units.back().empty();
  }
  return any ? units : std::vector<std::string>{};
}

class HeadReader {
 public:
  HeadReader(LineSource& lines, const std::function<bool(const std::string&)>& known)
      : lines_(lines), known_(known) {}

  CsvHead Read(const std::string& path) {
    CsvHead head;
    const auto named = FindKnown();
    const auto place = named ? named : AboveTheNumbers();
    if (read_.empty() || (!place && !first_numbers_)) {
      throw BadInput(fmt::format("{}: line 1: no column names; the file is empty", path));
    }
    if (place) {
      const std::string_view line = Uncommented(read_[*place].second);
      head.separator = SeparatorOf(line);
      head.names = CellsOf(line, head.separator);
      head.line = read_[*place].first;
    } else {
      head.separator = SeparatorOf(read_[*first_numbers_].second);
      const auto count = CellsOf(read_[*first_numbers_].second, head.separator).size();
      for (std::size_t i = 0; i < count; ++i) head.names.push_back(fmt::format("#{}", i + 1));
    }
    TakeRest(place ? *place + 1 : *first_numbers_, head);
    return head;
  }

 private:
  bool More() {
    std::string_view line;
    if (read_.size() >= kMostHeadLines || bytes_ >= kMostHeadBytes || !lines_.Next(line)) {
      return false;
    }
    bytes_ += line.size();
    read_.emplace_back(lines_.line_number(), line);
    return true;
  }

  bool HasKnown(std::string_view line) const {
    const std::string_view bare = Uncommented(line);
    return std::ranges::any_of(CellsOf(bare, SeparatorOf(bare)), known_);
  }

  /// Reads on to the line with a known name, or else to the first row of numbers.
  std::optional<std::size_t> FindKnown() {
    while (More()) {
      const std::string& line = read_.back().second;
      if (HasKnown(line)) return read_.size() - 1;
      if (IsNoRow(line)) continue;
      if (!first_text_) first_text_ = read_.size() - 1;
      if (!IsNumeric(line)) continue;
      first_numbers_ = read_.size() - 1;
      if (first_text_ == first_numbers_) first_text_.reset();
      return std::nullopt;
    }
    return std::nullopt;
  }

  /// The nearest line above the first numbers that has as many cells and is no row of units.
  std::optional<std::size_t> AboveTheNumbers() const {
    if (!first_numbers_) return first_text_;
    const std::string& numbers = read_[*first_numbers_].second;
    const std::size_t count = CellsOf(numbers, SeparatorOf(numbers)).size();
    for (std::size_t i = *first_numbers_; i-- > 0;) {
      const std::string_view line = Uncommented(read_[i].second);
      const char separator = SeparatorOf(line);
      if (CellsOf(line, separator).size() != count || line.empty()) continue;
      if (UnitsOfRow(line, separator, count).empty()) return i;
    }
    return std::nullopt;
  }

  /// What was read behind the names belongs to the rows, but for a row of units.
  void TakeRest(std::size_t from, CsvHead& head) {
    const auto next_row = [&]() -> std::optional<std::size_t> {
      for (std::size_t i = from;; ++i) {
        if (i == read_.size() && !More()) return std::nullopt;
        if (!IsNoRow(read_[i].second)) return i;
      }
    };
    const auto row = next_row();
    if (!row) return;
    if (head.line > 0) {
      head.units = UnitsOfRow(read_[*row].second, head.separator, head.names.size());
    }
    const std::size_t first = head.units.empty() ? *row : *row + 1;
    head.ahead.assign(read_.begin() + static_cast<std::ptrdiff_t>(first), read_.end());
  }

  LineSource& lines_;
  const std::function<bool(const std::string&)>& known_;
  std::vector<NumberedLine> read_;
  std::size_t bytes_{};
  std::optional<std::size_t> first_text_;
  std::optional<std::size_t> first_numbers_;
};

}  // namespace

bool IsNoRow(std::string_view line) {
  return line.find_first_not_of(" \t") == std::string_view::npos || IsComment(line) ||
         (line.starts_with("sep=") && line.size() == 5);
}

std::string UnitWord(std::string_view cell) {
  std::string word(Bare(cell, " \t\"[]()"));
  std::ranges::transform(word, word.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  constexpr std::array<std::pair<std::string_view, std::string_view>, 18> kSame{
      {{"µm", "um"},
       {"μm", "um"},
       {"micron", "um"},
       {"microns", "um"},
       {"sec", "s"},
       {"msec", "ms"},
       {"µs", "us"},
       {"μs", "us"},
       {"amp", "a"},
       {"1/min", "rpm"},
       {"u/min", "rpm"},
       {"rev/min", "rpm"},
       {"min-1", "rpm"},
       {"rad/s", "rad_per_s"},
       {"°", "deg"},
       {"degree", "deg"},
       {"degrees", "deg"},
       {"grad", "deg"}}};
  for (const auto& [other, ours] : kSame) {
    if (word == other) return std::string(ours);
  }
  constexpr std::array<std::string_view, 16> kOurs{"s",   "ms", "us",   "ns",       "m",   "mm",
                                                   "um",  "nm", "a",    "ma",       "rad", "deg",
                                                   "rpm", "hz", "turn", "rad_per_s"};
  return std::ranges::find(kOurs, word) != kOurs.end() ? word : std::string{};
}

bool ParseCell(std::string_view cell, char separator, double& value) {
  std::string with_point;
  // Where no comma parts the cells it is a decimal comma.
  if (separator != ',' && cell.find(',') != std::string_view::npos) {
    with_point = cell;
    with_point[with_point.find(',')] = '.';
    cell = with_point;
  }
  // from_chars knows no leading plus; behind it a minus would be a second sign.
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc{} && end == cell.data() + cell.size() && !cell.empty();
}

CsvHead ReadCsvHead(LineSource& lines, const std::string& path,
                    const std::function<bool(const std::string&)>& known) {
  return HeadReader(lines, known).Read(path);
}

}  // namespace levitas::session
