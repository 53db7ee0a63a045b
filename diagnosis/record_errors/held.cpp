// Held readings; see readings.hpp.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "diagnosis/record_errors/readings.hpp"
#include "diagnosis/record_errors/wiring.hpp"

namespace levitas::diagnosis {
namespace {

constexpr int kMostPeriod = 12;      ///< rows
constexpr double kHeldShare = 0.95;  ///< of the rows of a phase
constexpr double kMoves = 0.4;       ///< at most so many of the other rows repeat
constexpr double kTimesOthers = 5.0;
constexpr double kOftenest = 0.03;  ///< of all rows, where they are held now and then
constexpr double kFewestJudged = 200.0;

struct Repeating {
  int period{};    ///< rows; 0: not periodic
  int held{};      ///< of them
  double share{};  ///< of rows that repeat, those that every column repeats left out
};

/// Rows that can be judged: 1 repeats, 0 moves, -1 follows nothing or stands at a limit.
std::vector<int> Marks(const Columns& columns, const Eigen::MatrixXd& of, Eigen::Index a,
                       double limit) {
  std::vector<int> marks(static_cast<std::size_t>(columns.rows()), -1);
  for (Eigen::Index n = 1; n < columns.rows(); ++n) {
    const auto i = static_cast<std::size_t>(n);
    if (columns.missing[i] != 0 || std::abs(of(n, a)) >= limit) continue;
    marks[i] = of(n, a) == of(n - 1, a) ? 1 : 0;
  }
  return marks;
}

Repeating Judge(const Columns& columns, const std::vector<int>& marks) {
  Repeating out;
  double repeats = 0.0;
  double rows = 0.0;
  for (std::size_t n = 0; n < marks.size(); ++n) {
    if (marks[n] < 0 || columns.repeated[n] != 0) continue;
    rows += 1.0;
    repeats += marks[n];
  }
  out.share = rows > 0.0 ? repeats / rows : 0.0;
  if (rows < kFewestJudged) return out;
  for (int period = 2; period <= kMostPeriod && out.period == 0; ++period) {
    std::vector<double> same(static_cast<std::size_t>(period), 0.0);
    std::vector<double> all = same;
    // By row numbers: a span that begins anew may begin in another phase, so one span is judged.
    for (std::size_t n = 1; n < marks.size() && columns.missing[n] == 0; ++n) {
      if (marks[n] < 0) continue;
      const std::size_t phase = n % static_cast<std::size_t>(period);
      same[phase] += marks[n];
      all[phase] += 1.0;
    }
    int held = 0;
    int moving = 0;
    for (std::size_t p = 0; p < same.size(); ++p) {
      if (all[p] < 20.0) continue;
      if (same[p] > kHeldShare * all[p]) ++held;
      if (same[p] < kMoves * all[p]) ++moving;
    }
    if (held > 0 && moving > 0 && held + moving == period) {
      out.period = period;
      out.held = held;
    }
  }
  return out;
}

void AddHeld(const std::string& column, const Repeating& found, RecordErrors& out) {
  RecordError error{RecordErrorKind::kHeld, {column}, 0.0, found.share, {}, {}, false};
  if (found.period > 0) {
    error.size = static_cast<double>(found.held) / found.period;
    error.sentence =
        fmt::format("{} holds its value in {} of every {} rows", column, found.held, found.period);
  } else {
    error.size = found.share;
    error.sentence = fmt::format("{} holds its value in {:.2g} % of the rows, the others do not",
                                 column, 100.0 * found.share);
  }
  error.mend = "record it at the rate of the others; no map of columns mends it";
  out.errors.push_back(std::move(error));
}

}  // namespace

void FindHeld(const RigView& rig, const Columns& columns, RecordErrors& out) {
  for (const bool position : {true, false}) {
    const Eigen::MatrixXd& of = position ? columns.position_m : columns.current_a;
    std::vector<Repeating> found;
    std::vector<double> shares;
    for (Eigen::Index a = 0; a < columns.axes(); ++a) {
      const double limit_a = CurrentLimit(rig, static_cast<std::size_t>(a));
      found.push_back(Judge(columns, Marks(columns, of, a, position ? 1.0 : 0.999 * limit_a)));
      shares.push_back(found.back().share);
    }
    const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
    std::nth_element(shares.begin(), middle, shares.end());
    for (std::size_t a = 0; a < found.size(); ++a) {
      const bool often = columns.axes() > 2 && found[a].share > kOftenest &&
                         found[a].share > kTimesOthers * (*middle + 0.002);
      const std::string column = position ? PositionColumn(rig, a) : CurrentColumn(rig, a);
      // Coarse steps and plateaus repeat too.
      const bool known = std::ranges::any_of(
          out.errors, [&](const RecordError& error) { return error.columns.front() == column; });
      if (found[a].period == 0 && (!often || known)) continue;
      AddHeld(column, found[a], out);
    }
  }
}

}  // namespace levitas::diagnosis
