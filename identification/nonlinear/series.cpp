#include "identification/nonlinear/series.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "common/problem.hpp"
#include "session/exchange/csv_columns.hpp"
#include "session/exchange/line_source.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

/// Fewer rows than this many per unknown let noise decide.
constexpr std::size_t kRowsPerUnknown = 10;
/// Share of the rows that stand exactly at the largest or smallest value of a clipped signal.
constexpr double kTimeShare = 0.5;  ///< of the usual step: time stamps are rounded, rows are not
constexpr double kClippedShare = 0.02;

std::size_t Number(std::string_view text, const std::string& whole) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw BadInput(fmt::format("range '{}': needed FIRST:END in rows, such as 100:40575", whole));
  }
  return value;
}

/// Where each named column stands in the file.
class Columns {
 public:
  Columns(std::string_view header, std::string path) : path_(std::move(path)) {
    const auto semicolons = std::ranges::count(header, ';');
    separator_ = semicolons > std::ranges::count(header, ',') ? ';' : ',';
    std::vector<std::string_view> cells;
    session::SplitCsv(header, separator_, cells);
    names_.assign(cells.begin(), cells.end());
  }
  [[nodiscard]] char separator() const noexcept { return separator_; }
  [[nodiscard]] bool Has(const std::string& name) const {
    return std::ranges::find(names_, name) != names_.end();
  }
  [[nodiscard]] std::size_t At(const std::string& name) const {
    const auto at = std::ranges::find(names_, name);
    if (at == names_.end()) {
      throw BadInput(fmt::format("{}: line 1: no column '{}'; there are: {}", path_, name,
                                 fmt::join(names_, ", ")));
    }
    return static_cast<std::size_t>(at - names_.begin());
  }

 private:
  std::string path_;
  std::vector<std::string> names_;
  char separator_{','};
};

double Cell(const std::vector<std::string_view>& cells, std::size_t at, char separator,
            const std::string& where) {
  if (at >= cells.size()) {
    throw BadInput(fmt::format("{}: {} cells, needed {}", where, cells.size(), at + 1));
  }
  std::string text(cells[at]);
  if (separator == ';') std::ranges::replace(text, ',', '.');
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    throw BadInput(fmt::format("{}: column {}: '{}' is no finite number", where, at + 1, text));
  }
  return value;
}

Eigen::MatrixXd Matrix(const std::vector<session::Column>& columns) {
  const auto rows = columns.empty() ? 0 : static_cast<Index>(columns.front().size());
  Eigen::MatrixXd matrix(rows, static_cast<Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    matrix.col(static_cast<Index>(c)) = Eigen::Map<const Eigen::VectorXd>(columns[c].data(), rows);
  }
  return matrix;
}

/// Models of samples know one period only: a time that falls, stands or leaps is another one.
void RefuseUnevenTime(const session::Column& time_s, const std::string& path) {
  std::vector<double> steps_s(time_s.size() - 1);
  for (std::size_t k = 0; k < steps_s.size(); ++k) steps_s[k] = time_s[k + 1] - time_s[k];
  std::vector<double> sorted = steps_s;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double usual_s = *middle;
  for (std::size_t k = 0; k < steps_s.size(); ++k) {
    if (steps_s[k] > 0.0 && std::abs(steps_s[k] - usual_s) <= kTimeShare * usual_s) continue;
    throw BadInput(fmt::format(
        "{}: column time_s: a step of {:g} s at row {}, the usual step is {:g} s; allowed: steps "
        "that rise and differ by at most {:.0f} % from the usual one. Resample the record, "
        "or leave the column out and give the sampling rate",
        path, steps_s[k], k + 1, usual_s, 100.0 * kTimeShare));
  }
}

void RefuseColumn(const Eigen::VectorXd& values, const std::string& name, bool input) {
  if (!values.allFinite()) {
    throw BadInput(
        fmt::format("{} '{}' has values that are no numbers", input ? "input" : "output", name));
  }
  const double high = values.maxCoeff();
  const double low = values.minCoeff();
  if (!(high > low)) {
    throw BadInput(input ? fmt::format("input '{}' never changes: nothing was excited", name)
                         : fmt::format("output '{}' is dead: it never changes", name));
  }
  if (input) return;  // a binary input stands at its limits, and may
  const auto rows = static_cast<double>(values.size());
  const auto at_limit = static_cast<double>(
      std::max((values.array() == high).count(), (values.array() == low).count()));
  if (at_limit > kClippedShare * rows) {
    throw BadInput(fmt::format(
        "output '{}' is clipped: {:.1f} % of its rows stand at its largest or smallest value; use "
        "a smaller amplitude",
        name, 100.0 * at_limit / rows));
  }
}

}  // namespace

RowRange ParseRange(const std::string& text, std::size_t rows) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) {
    throw BadInput(fmt::format("range '{}': needed FIRST:END in rows, such as 100:40575", text));
  }
  const std::string_view view(text);
  RowRange range{0, rows};
  if (colon > 0) range.begin = Number(view.substr(0, colon), text);
  if (colon + 1 < text.size()) range.end = Number(view.substr(colon + 1), text);
  if (range.begin >= range.end || range.end > rows) {
    throw BadInput(fmt::format("range '{}': the data have rows 0 to {}", text, rows));
  }
  return range;
}

Series Slice(const Series& s, const RowRange& range) {
  const auto begin = static_cast<Index>(range.begin);
  const auto count = static_cast<Index>(range.end - range.begin);
  Series part = s;
  part.input = s.input.middleRows(begin, count);
  part.output = s.output.middleRows(begin, count);
  return part;
}

Series ReadSeries(const std::string& path, const SeriesColumns& wanted, double period_s) {
  session::LineSource lines(path);
  std::string_view line;
  if (!lines.Next(line)) throw BadInput(path + ": empty file");
  const Columns columns(line, path);
  std::vector<std::size_t> at;
  for (const auto* names : {&wanted.inputs, &wanted.outputs}) {
    for (const std::string& name : *names) at.push_back(columns.At(name));
  }
  const bool timed = columns.Has("time_s");
  if (timed) at.push_back(columns.At("time_s"));
  std::vector<session::Column> values(at.size());
  std::vector<std::string_view> cells;
  while (lines.Next(line)) {
    if (line.empty()) continue;
    session::SplitCsv(line, columns.separator(), cells);
    const std::string where = fmt::format("{}: line {}", path, lines.line_number());
    for (std::size_t c = 0; c < at.size(); ++c) {
      values[c].push_back(Cell(cells, at[c], columns.separator(), where));
    }
  }
  if (values.front().size() < 2) throw BadInput(path + ": fewer than two rows");
  Series series{period_s, wanted.inputs, wanted.outputs, {}, {}};
  if (timed) {
    const session::Column& time_s = values.back();
    RefuseUnevenTime(time_s, path);
    series.period_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
    values.pop_back();
  }
  if (!(series.period_s > 0.0)) {
    throw BadInput(path + ": no column time_s: give the sampling rate");
  }
  const auto inputs = static_cast<std::ptrdiff_t>(wanted.inputs.size());
  series.input = Matrix({values.begin(), values.begin() + inputs});
  series.output = Matrix({values.begin() + inputs, values.end()});
  return series;
}

Series SeriesOf(const session::Recording& record, const SeriesColumns& wanted) {
  std::map<std::string, const session::Column*> known;
  const session::Column never_excited(record.rows(), 0.0);
  for (std::size_t axis = 0; axis < record.axes(); ++axis) {
    const session::Column& excitation = record.excitation_a[axis];
    known["position_" + record.channels[axis]] = &record.position_m[axis];
    known["control_current_" + record.channels[axis]] = &record.current_a[axis];
    known["excitation_" + record.channels[axis]] =
        excitation.empty() ? &never_excited : &excitation;
  }
  const auto gather = [&](const std::vector<std::string>& names) {
    std::vector<session::Column> columns;
    for (const std::string& name : names) {
      const auto at = known.find(name);
      if (at == known.end()) {
        std::vector<std::string> all;
        all.reserve(known.size());
        for (const auto& [other, column] : known) all.push_back(other);
        throw BadInput(fmt::format("{}: no signal '{}'; there are: {}", record.name, name,
                                   fmt::join(all, ", ")));
      }
      columns.push_back(*at->second);
    }
    return Matrix(columns);
  };
  return {record.period_s(), wanted.inputs, wanted.outputs, gather(wanted.inputs),
          gather(wanted.outputs)};
}

void RefuseUnfit(const Series& series, std::size_t unknowns) {
  // Columns without names are told by their numbers.
  const auto name = [](const std::vector<std::string>& names, Index i) {
    const auto at = static_cast<std::size_t>(i);
    return at < names.size() ? names[at] : std::to_string(at + 1);
  };
  for (Index i = 0; i < series.inputs(); ++i) {
    RefuseColumn(series.input.col(i), name(series.input_names, i), true);
  }
  for (Index i = 0; i < series.outputs(); ++i) {
    RefuseColumn(series.output.col(i), name(series.output_names, i), false);
  }
  if (static_cast<std::size_t>(series.rows()) < kRowsPerUnknown * unknowns) {
    throw BadInput(fmt::format("{} rows for {} unknowns: needed are {} at least", series.rows(),
                               unknowns, kRowsPerUnknown * unknowns));
  }
}

}  // namespace levitas::identification
