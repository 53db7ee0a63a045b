#include "diagnosis/levitator/fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace levitas::levitator {
namespace {

using Index = Eigen::Index;

double Penalty(const Freedom& freedom, const Theta& theta) {
  double sum = 0.0;
  for (std::size_t i = 0; i < freedom.active.size(); ++i) {
    const double z = theta[freedom.active[i]] / freedom.deviation[static_cast<Index>(i)];
    sum += z * z;
  }
  return sum;
}

Eigen::VectorXd Scaled(const Freedom& freedom, const Theta& theta) {
  Eigen::VectorXd z(freedom.deviation.size());
  for (std::size_t i = 0; i < freedom.active.size(); ++i) {
    z[static_cast<Index>(i)] = theta[freedom.active[i]];
  }
  return z.cwiseQuotient(freedom.deviation);
}

/// Half log determinant of what the data and the prior know together.
double HalfLogDeterminant(const Eigen::LLT<Eigen::MatrixXd>& llt) {
  return Eigen::MatrixXd(llt.matrixL()).diagonal().array().log().sum();
}

double PriorOf(const Freedom& freedom) {
  // What cannot be negative has half the volume.
  return freedom.log_prior + static_cast<double>(freedom.one_sided) * std::log(2.0);
}

/// Sums in units of the priors, those of the priors added.
struct Normal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd slope;
};

Normal WithPriors(const Sums& sums, const Freedom& freedom, const Eigen::VectorXd& z) {
  const auto scale = freedom.deviation.asDiagonal();
  Normal normal{scale * sums.jtj * scale, scale * sums.jte};
  normal.matrix.diagonal().array() += 1.0;
  normal.slope += z;
  return normal;
}

/// Takes out what stands at a bound and would go beyond it.
void Freeze(const Freedom& freedom, const Eigen::VectorXd& z, Normal& normal) {
  for (Index i = 0; i < z.size(); ++i) {
    const double value = z[i] * freedom.deviation[i];
    const bool low = value <= freedom.least[i] && normal.slope[i] > 0.0;
    const bool high = value >= freedom.most[i] && normal.slope[i] < 0.0;
    if (!low && !high) continue;
    normal.slope[i] = 0.0;
    normal.matrix.row(i).setZero();
    normal.matrix.col(i).setZero();
    normal.matrix(i, i) = 1.0;
  }
}

struct Step {
  Theta theta;
  double cost{};
};

/// One Levenberg-Marquardt step: raises the damping until the cost falls; else returns the start.
Step TryStep(const Misfit& misfit, const Filters& filters, const Freedom& freedom, Normal normal,
             const Theta& theta, double cost, double& caution) {
  const Eigen::VectorXd z = Scaled(freedom, theta);
  Freeze(freedom, z, normal);
  for (int attempt = 0; attempt < 6; ++attempt) {
    Eigen::MatrixXd damped = normal.matrix;
    damped.diagonal() *= 1.0 + caution;
    const Eigen::VectorXd moved = z - damped.llt().solve(normal.slope);
    Step step{theta, 0.0};
    for (std::size_t i = 0; i < freedom.active.size(); ++i) {
      const std::size_t index = freedom.active[i];
      const auto at = static_cast<Index>(i);
      step.theta[index] =
          std::clamp(moved[at] * freedom.deviation[at], freedom.least[at], freedom.most[at]);
    }
    step.cost = misfit.SquaredSum(step.theta, filters) + Penalty(freedom, step.theta);
    if (std::isfinite(step.cost) && step.cost < cost) {
      caution *= 0.1;
      return step;
    }
    caution = std::max(1e-3, caution * 10.0);
  }
  return {theta, cost};
}

}  // namespace

Freedom FreedomOf(const CauseSet& causes, std::size_t records, const Theta& origin) {
  const std::size_t all = kParameters + records * kOwnParameters;
  std::vector<double> variance(all);
  std::vector<double> most(all);
  std::vector<double> least(all);
  for (std::size_t i = 0; i < all; ++i) {
    variance[i] = ToleranceOf(i) * ToleranceOf(i);
    most[i] = kFarthest * ToleranceOf(i);
    least[i] = std::max(LeastOf(i, origin), -most[i]);
  }
  Freedom freedom;
  for (const std::size_t c : causes) {
    const Cause& cause = Causes()[c];
    freedom.log_prior += cause.log_prior;
    for (const std::size_t i : cause.moves) {
      variance[i] += WideOf(i) * WideOf(i);
      most[i] = std::numeric_limits<double>::max();
      least[i] = LeastOf(i, origin);
      if (ToleranceOf(i) == 0.0 && least[i] == 0.0) ++freedom.one_sided;
    }
  }
  for (std::size_t i = 0; i < all; ++i) {
    if (variance[i] > 0.0) freedom.active.push_back(i);
  }
  const auto count = static_cast<Index>(freedom.active.size());
  freedom.deviation.resize(count);
  freedom.least.resize(count);
  freedom.most.resize(count);
  for (Index at = 0; at < count; ++at) {
    const std::size_t i = freedom.active[static_cast<std::size_t>(at)];
    freedom.deviation[at] = std::sqrt(variance[i]);
    freedom.least[at] = least[i];
    freedom.most[at] = most[i];
  }
  return freedom;
}

Fitted Fitter::Fit(const CauseSet& causes, const Theta& start, const Filters& filters,
                   int steps) const {
  const Freedom freedom = FreedomOf(causes, misfit_.series().size(), misfit_.rig().origin);
  Fitted out;
  out.theta = Zeros(misfit_.series().size());
  for (std::size_t i = 0; i < freedom.active.size(); ++i) {
    const auto at = static_cast<Index>(i);
    out.theta[freedom.active[i]] =
        std::clamp(start[freedom.active[i]], freedom.least[at], freedom.most[at]);
  }
  double cost = misfit_.SquaredSum(out.theta, filters) + Penalty(freedom, out.theta);
  double caution = 1e-4;
  Sums sums;
  for (int step = 0; step < steps; ++step) {
    sums = misfit_.Linearise(out.theta, filters, freedom.active);
    const Normal normal = WithPriors(sums, freedom, Scaled(freedom, out.theta));
    const Step next = TryStep(misfit_, filters, freedom, normal, out.theta, cost, caution);
    const double gained = cost - next.cost;
    out.theta = next.theta;
    cost = next.cost;
    // Converged: the Jacobian of this step is reused for the covariance.
    if (gained < std::max(1.0, 1e-6 * cost)) break;
  }
  const Normal normal = WithPriors(sums, freedom, Scaled(freedom, out.theta));
  const Eigen::LLT<Eigen::MatrixXd> llt(normal.matrix);
  out.squared_sum = cost - Penalty(freedom, out.theta);
  out.evidence = -0.5 * cost - HalfLogDeterminant(llt) + PriorOf(freedom);
  const Eigen::MatrixXd covariance =
      llt.solve(Eigen::MatrixXd::Identity(normal.matrix.rows(), normal.matrix.cols()));
  out.deviation = Zeros(misfit_.series().size());
  for (std::size_t i = 0; i < freedom.active.size(); ++i) {
    const auto at = static_cast<Index>(i);
    out.deviation[freedom.active[i]] = freedom.deviation[at] * std::sqrt(covariance(at, at));
  }
  return out;
}

Filters Fitter::Noise() const {
  CauseSet everything(Causes().size());
  for (std::size_t c = 0; c < everything.size(); ++c) everything[c] = c;
  Theta theta = Zeros(misfit_.series().size());
  // Scaled alone at first: what is not explained yet is no noise.
  const Filters filters = misfit_.Whiten(theta, 0);
  constexpr int kSteps = 8;
  theta = Fit(everything, theta, filters, kSteps).theta;
  theta = Fit(everything, theta, misfit_.Whiten(theta, 0), kSteps).theta;
  return misfit_.Whiten(theta, kMemory);
}

std::vector<double> Fitter::Screen(const CauseSet& causes, const Fitted& at,
                                   const Filters& filters) const {
  const std::size_t records = misfit_.series().size();
  std::vector<std::size_t> everything(at.theta.size());
  for (std::size_t i = 0; i < everything.size(); ++i) everything[i] = i;
  const Sums sums = misfit_.Linearise(at.theta, filters, everything);
  const auto evidence = [&](const CauseSet& set, bool& possible) {
    const Freedom freedom = FreedomOf(set, records, misfit_.rig().origin);
    const std::vector<Index> pick(freedom.active.begin(), freedom.active.end());
    const Sums part{sums.jtj(pick, pick), sums.jte(pick), sums.ete, sums.values};
    const Eigen::VectorXd z = Scaled(freedom, at.theta);
    Normal normal = WithPriors(part, freedom, z);
    Freeze(freedom, z, normal);
    const Eigen::LLT<Eigen::MatrixXd> llt(normal.matrix);
    const Eigen::VectorXd step = -llt.solve(normal.slope);
    possible = true;
    for (std::size_t i = 0; i < pick.size(); ++i) {
      const std::size_t index = freedom.active[i];
      const double value = (z[static_cast<Index>(i)] + step[static_cast<Index>(i)]) *
                           freedom.deviation[static_cast<Index>(i)];
      if (WideOf(index) > 0.0 && ToleranceOf(index) == 0.0 &&
          value < LeastOf(index, misfit_.rig().origin)) {
        possible = false;
      }
    }
    const double predicted = sums.ete + z.squaredNorm() + step.dot(normal.slope);
    return -0.5 * predicted - HalfLogDeterminant(llt) + PriorOf(freedom);
  };
  bool possible = true;
  const double base = evidence(causes, possible);
  std::vector<double> gain;
  for (std::size_t c = 0; c < Causes().size(); ++c) {
    CauseSet with = causes;
    with.push_back(c);
    const double value = evidence(with, possible);
    gain.push_back(possible ? value - base : -std::numeric_limits<double>::infinity());
  }
  return gain;
}

}  // namespace levitas::levitator
