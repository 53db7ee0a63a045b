#include "identification/modal/normal_cost.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <span>
#include <thread>
#include <utility>

#include "numerics/factors/factors.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

/// Lines whose rows are added to the matrix together: long enough for the product to be fast,
/// short enough to stay in the cache.
constexpr std::size_t kTogether = 8;
/// Fewer lines than this are not worth a thread.
constexpr std::size_t kPerThread = 32;

/// What a line adds to twice the cost, and what its rows are weighted with.
struct RobustPart {
  double twice_cost{};
  double weight{};
};

RobustPart SoftL1(double square, Index rows) {
  const auto bend = static_cast<double>(rows);
  const double root = std::sqrt(1.0 + square / bend);
  // rho' = 1/root weighs the square.
  return {2.0 * bend * (root - 1.0), 1.0 / std::sqrt(root)};
}

}  // namespace

NormalCost::NormalCost(const ModalStart& start, Eigen::VectorXd base, std::vector<Index> free,
                       std::vector<LineResiduals> lines, bool robust, int threads)
    : start_(start),
      base_(std::move(base)),
      free_(std::move(free)),
      lines_(std::move(lines)),
      robust_(robust),
      threads_(threads) {
  const auto count = static_cast<int>(free_.size());
  set_num_residuals(count + 1);
  mutable_parameter_block_sizes()->push_back(count);
}

Eigen::VectorXd NormalCost::Whole(const double* free) const {
  Eigen::VectorXd vector = base_;
  for (std::size_t k = 0; k < free_.size(); ++k) vector[free_[k]] = free[k];
  return vector;
}

void NormalCost::Add(const Physical& rig, std::size_t from, std::size_t to, bool derive,
                     Sum& sum) const {
  const auto count = static_cast<Index>(free_.size());
  Index most = 0;
  for (const LineResiduals& line : lines_) most = std::max(most, line.rows());
  const auto together = static_cast<Index>(kTogether);
  Eigen::VectorXd residuals(together * most);
  RowMajor jacobian(together * most, derive ? count : 0);
  ResponseDerivative workspace;
  Index filled = 0;
  const auto flush = [&] {
    if (!derive || filled == 0) return;
    const auto j = jacobian.topRows(filled);
    sum.gradient.noalias() += j.transpose() * residuals.head(filled);
    sum.matrix.selfadjointView<Eigen::Lower>().rankUpdate(j.transpose());
    filled = 0;
  };
  for (std::size_t n = from; n < to; ++n) {
    const Index rows = lines_[n].rows();
    auto r = residuals.segment(filled, rows);
    const std::span<double> own(r.data(), static_cast<std::size_t>(rows));
    if (derive) {
      lines_[n].Evaluate(rig, free_, workspace, own, jacobian.middleRows(filled, rows));
    } else {
      lines_[n].Evaluate(rig, own);
    }
    const double square = r.squaredNorm();
    if (!robust_) {
      sum.twice_cost += square;
    } else {
      const RobustPart part = SoftL1(square, rows);
      sum.twice_cost += part.twice_cost;
      if (derive) {
        r *= part.weight;
        jacobian.middleRows(filled, rows) *= part.weight;
      }
    }
    if (!derive) continue;
    filled += rows;
    if (filled + most > residuals.size()) flush();
  }
  flush();
}

NormalCost::Sum NormalCost::Total(const Eigen::VectorXd& vector, bool derive) const {
  const Physical rig = ToPhysical(start_.frame, vector);
  const auto count = static_cast<Index>(derive ? free_.size() : 0);
  const std::size_t parts =
      std::clamp<std::size_t>(lines_.size() / kPerThread, 1, static_cast<std::size_t>(threads_));
  std::vector<Sum> sums(
      parts, Sum{0.0, Eigen::VectorXd::Zero(count), Eigen::MatrixXd::Zero(count, count)});
  const auto part = [&](std::size_t n) {
    Add(rig, n * lines_.size() / parts, (n + 1) * lines_.size() / parts, derive, sums[n]);
  };
  {
    std::vector<std::jthread> others;
    others.reserve(parts - 1);
    for (std::size_t n = 1; n < parts; ++n) others.emplace_back(part, n);
    part(0);
  }
  // In order, so that the same start gives the same bits however the threads ran.
  for (std::size_t n = 1; n < parts; ++n) {
    sums[0].twice_cost += sums[n].twice_cost;
    sums[0].gradient += sums[n].gradient;
    sums[0].matrix += sums[n].matrix;
  }
  const Eigen::VectorXd pull = (vector - start_.vector).cwiseQuotient(start_.prior);
  sums[0].twice_cost += pull.squaredNorm();
  for (Index k = 0; k < count; ++k) {
    const Index at = free_[static_cast<std::size_t>(k)];
    sums[0].gradient[k] += pull[at] / start_.prior[at];
    sums[0].matrix(k, k) += 1.0 / (start_.prior[at] * start_.prior[at]);
  }
  return std::move(sums[0]);
}

bool NormalCost::Evaluate(double const* const* parameters, double* residuals,
                          double** jacobians) const {
  const bool derive = jacobians != nullptr && jacobians[0] != nullptr;
  const Eigen::VectorXd vector = Whole(parameters[0]);
  const Sum sum = Total(vector, derive);
  if (!std::isfinite(sum.twice_cost)) return false;
  const auto count = static_cast<Index>(free_.size());
  Eigen::Map<Eigen::VectorXd> r(residuals, count + 1);
  r.setZero();
  r[count] = std::sqrt(sum.twice_cost);
  if (!derive) return true;
  const Eigen::LLT<Eigen::MatrixXd> factor(sum.matrix);
  if (factor.info() != Eigen::Success) return false;
  r.head(count) = factor.matrixL().solve(sum.gradient);
  r[count] = std::sqrt(std::max(0.0, sum.twice_cost - r.head(count).squaredNorm()));
  Eigen::Map<RowMajor> jacobian(jacobians[0], count + 1, count);
  jacobian.setZero();
  jacobian.topRows(count) = factor.matrixU();
  return true;
}

}  // namespace levitas::identification
