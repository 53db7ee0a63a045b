#include "identification/nonlinear/frols.hpp"

#include <cmath>

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr double kCollinear = 1e-8;

struct Best {
  Index column{-1};
  double ratio{-1.0};
};

/// The free candidate that explains most of `target`; `left` are squares, `start` those before.
Best Choose(const Eigen::MatrixXd& p, const Eigen::VectorXd& target, const Eigen::VectorXd& start,
            const std::vector<bool>& taken) {
  Best best;
  const double total = target.squaredNorm();
  for (Index j = 0; j < p.cols(); ++j) {
    if (taken[static_cast<std::size_t>(j)]) continue;
    const double left = p.col(j).squaredNorm();
    if (!(left > kCollinear * start[j])) continue;
    const double along = p.col(j).dot(target);
    const double ratio = along * along / (left * total);
    if (ratio > best.ratio) best = {j, ratio};
  }
  return best;
}

/// Parameters of the chosen columns: R theta = g.
Eigen::VectorXd SolveChosen(const Eigen::MatrixXd& r, const Eigen::VectorXd& g,
                            const std::vector<Index>& chosen) {
  const auto count = static_cast<Index>(chosen.size());
  Eigen::MatrixXd upper(count, count);
  for (Index i = 0; i < count; ++i) {
    upper.col(i) = r.col(chosen[static_cast<std::size_t>(i)]).head(count);
  }
  return upper.triangularView<Eigen::Upper>().solve(g.head(count));
}

}  // namespace

FrolsResult SelectTerms(Eigen::MatrixXd p, const Eigen::VectorXd& target,
                        const FrolsOptions& options) {
  const Index columns = p.cols();
  const Eigen::VectorXd start = p.colwise().squaredNorm().transpose();
  std::vector<bool> taken(static_cast<std::size_t>(columns), false);
  const auto most = static_cast<Index>(options.most_terms);
  // R of the decomposition: row i holds what candidate columns have along the i-th direction.
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(most, columns);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(most);
  FrolsResult result;
  const double total = target.squaredNorm();
  for (Index step = 0; step < most; ++step) {
    const auto n = static_cast<std::size_t>(step);
    Best best;
    if (n < options.compulsory.size()) {
      const Index j = options.compulsory[n];
      const double along = p.col(j).dot(target);
      const double left = p.col(j).squaredNorm();
      if (!(left > kCollinear * start[j])) continue;
      best = {j, along * along / (left * total)};
    } else {
      best = Choose(p, target, start, taken);
      if (best.column < 0 || best.ratio < options.least_ratio) break;
    }
    const auto row = static_cast<Index>(result.chosen.size());
    const Eigen::VectorXd direction = p.col(best.column).normalized();
    taken[static_cast<std::size_t>(best.column)] = true;
    g[row] = direction.dot(target);
    for (Index j = 0; j < columns; ++j) {
      if (taken[static_cast<std::size_t>(j)] && j != best.column) continue;
      r(row, j) = direction.dot(p.col(j));
      if (j != best.column) p.col(j) -= r(row, j) * direction;
    }
    result.chosen.push_back(best.column);
    result.ratio.push_back(best.ratio);
  }
  result.theta = SolveChosen(r, g, result.chosen);
  return result;
}

}  // namespace levitas::identification
