#include "identification/law/law_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"

namespace levitas::identification {
namespace {

session::RowRange Longest(const session::Recording& run) {
  session::RowRange longest;
  for (const session::RowRange& interval : run.LevitatedIntervals())
    if (interval.end - interval.begin > longest.end - longest.begin) longest = interval;
  if (longest.end == longest.begin) throw BadInput(run.name + ": no levitated rows");
  return longest;
}

session::RowRange RowsOf(const session::Recording& run, std::size_t axis,
                         const session::RowRange& all) {
  session::RowRange rows{all.end, all.begin};
  for (std::size_t row = all.begin; row < all.end; ++row) {
    if (run.ExcitationOf(axis, row) == 0.0 && run.PositionExcitationOf(axis, row) == 0.0) continue;
    rows.begin = std::min(rows.begin, row);
    rows.end = row + 1;
  }
  return rows.begin < rows.end ? rows : all;
}

}  // namespace

std::vector<LawSignals> ReadLawSignals(const session::Recording& run) {
  const session::RowRange all = Longest(run);
  std::vector<LawSignals> signals;
  for (std::size_t axis = 0; axis < run.axes(); ++axis) {
    const session::RowRange rows = RowsOf(run, axis, all);
    const auto count = static_cast<Eigen::Index>(rows.end - rows.begin);
    LawSignals one{run.channels[axis], Eigen::VectorXd(count), Eigen::VectorXd(count)};
    for (std::size_t row = rows.begin; row < rows.end; ++row) {
      const auto at = static_cast<Eigen::Index>(row - rows.begin);
      if (std::abs(run.current_a[axis][row]) >= run.current_limit_a) {
        throw BadInput(fmt::format(
            "{}: the control current of {} is at its limit of {:.3g} A in cycle {}, where the law "
            "is cut off; excite less",
            run.name, run.channels[axis], run.current_limit_a, run.cycle[row]));
      }
      one.input[at] = run.position_m[axis][row] + run.PositionExcitationOf(axis, row);
      one.output[at] = run.current_a[axis][row] - run.ExcitationOf(axis, row);
    }
    signals.push_back(std::move(one));
  }
  return signals;
}

}  // namespace levitas::identification
