#include "diagnosis/levitator/fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/problem.hpp"
#include "numerics/factors/factors.hpp"
#include "numerics/minimum/levenberg_marquardt.hpp"

namespace levitas::levitator {
namespace {

using Index = Eigen::Index;

Eigen::VectorXd Scaled(const Freedom& freedom, const Theta& theta) {
  Eigen::VectorXd z(freedom.deviation.size());
  for (std::size_t i = 0; i < freedom.active.size(); ++i) {
    z[static_cast<Index>(i)] = theta[freedom.active[i]];
  }
  return z.cwiseQuotient(freedom.deviation);
}

double Penalty(const Freedom& freedom, const Theta& theta) {
  const Eigen::VectorXd z = Scaled(freedom, theta);
  return z.dot(freedom.precision * z);
}

/// Half log determinant of what the data and the prior know together.
double HalfLogDeterminant(const Eigen::LLT<Eigen::MatrixXd>& llt) {
  return Eigen::MatrixXd(llt.matrixL()).diagonal().array().log().sum();
}

double PriorOf(const Freedom& freedom) {
  // What cannot be negative has half the volume.
  return freedom.log_prior + static_cast<double>(freedom.one_sided) * std::log(2.0) +
         HalfLogDeterminant(Eigen::LLT<Eigen::MatrixXd>(freedom.precision));
}

/// Normal equations in units of the priors, the priors added as residuals.
numerics::NormalEquations WithPriors(const Sums& sums, const Freedom& freedom,
                                     const Eigen::VectorXd& z) {
  const auto scale = freedom.deviation.asDiagonal();
  numerics::NormalEquations equations{scale * sums.jtj * scale, scale * sums.jte};
  equations.matrix += freedom.precision;
  equations.gradient += freedom.precision * z;
  return equations;
}

/// Removes the parameters that stand at a bound and would leave it.
void Freeze(const Freedom& freedom, const Eigen::VectorXd& z,
            numerics::NormalEquations& equations) {
  for (Index i = 0; i < z.size(); ++i) {
    const double value = z[i] * freedom.deviation[i];
    const bool low = value <= freedom.least[i] && equations.gradient[i] > 0.0;
    const bool high = value >= freedom.most[i] && equations.gradient[i] < 0.0;
    if (!low && !high) continue;
    equations.gradient[i] = 0.0;
    equations.matrix.row(i).setZero();
    equations.matrix.col(i).setZero();
    equations.matrix(i, i) = 1.0;
  }
}

/// Whitened residuals and priors as one sum of squares, for numerics::LevenbergMarquardt.
class PenalisedMisfit {
 public:
  using Iterate = numerics::Iterate<Theta>;

  PenalisedMisfit(const Misfit& misfit, const Filters& filters, const Freedom& freedom)
      : misfit_(misfit), filters_(filters), freedom_(freedom) {}

  [[nodiscard]] Iterate At(Theta theta) const {
    const double cost = misfit_.SquaredSum(theta, filters_) + Penalty(freedom_, theta);
    return {std::move(theta), cost};
  }
  [[nodiscard]] Iterate Step(const Theta& from, const Eigen::VectorXd& step) const {
    const Eigen::VectorXd moved = Scaled(freedom_, from) + step;
    Theta theta = from;
    for (std::size_t i = 0; i < freedom_.active.size(); ++i) {
      const auto at = static_cast<Index>(i);
      theta[freedom_.active[i]] =
          std::clamp(moved[at] * freedom_.deviation[at], freedom_.least[at], freedom_.most[at]);
    }
    return At(std::move(theta));
  }
  [[nodiscard]] std::optional<numerics::NormalEquations> Linearise(const Iterate& at) {
    sums_ = misfit_.Linearise(at.point, filters_, freedom_.active);
    const Eigen::VectorXd z = Scaled(freedom_, at.point);
    numerics::NormalEquations equations = WithPriors(sums_, freedom_, z);
    Freeze(freedom_, z, equations);
    return equations;
  }
  /// Of the last linearisation.
  [[nodiscard]] const Sums& sums() const noexcept { return sums_; }

 private:
  const Misfit& misfit_;
  const Filters& filters_;
  const Freedom& freedom_;
  Sums sums_;
};

/// Prior of a healthy rig: of independent tolerances, or as healthy records left it.
Eigen::MatrixXd HealthyCovariance(std::size_t all, const Eigen::MatrixXd& known) {
  Eigen::VectorXd variance(static_cast<Index>(all));
  for (std::size_t i = 0; i < all; ++i) {
    variance[static_cast<Index>(i)] = ToleranceOf(i) * ToleranceOf(i);
  }
  Eigen::MatrixXd covariance = variance.asDiagonal();
  if (known.size() > 0) covariance.topLeftCorner(kParameters, kParameters) = known;
  return covariance;
}

/// Inverse covariance of what is active, in units of its deviations.
Eigen::MatrixXd PrecisionOf(const Eigen::MatrixXd& covariance, const Freedom& freedom) {
  const std::vector<Index> pick(freedom.active.begin(), freedom.active.end());
  const Eigen::MatrixXd identity =
      Eigen::MatrixXd::Identity(freedom.deviation.size(), freedom.deviation.size());
  const Eigen::MatrixXd chosen = covariance(pick, pick);
  if (chosen.isDiagonal(0.0)) return identity;
  const auto scale = freedom.deviation.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd correlation = scale * chosen * scale;
  return Eigen::LLT<Eigen::MatrixXd>(correlation).solve(identity);
}

/// From the covariance in units of the prior's deviations.
void SetPosterior(const Freedom& freedom, const Eigen::MatrixXd& scaled, Fitted& out) {
  const auto scale = freedom.deviation.asDiagonal();
  const Eigen::MatrixXd covariance = scale * scaled * scale;
  out.deviation.assign(out.theta.size(), 0.0);
  for (std::size_t i = 0; i < freedom.active.size(); ++i) {
    const auto at = static_cast<Index>(i);
    out.deviation[freedom.active[i]] = std::sqrt(covariance(at, at));
  }
  // Common values come first.
  const auto own = std::lower_bound(freedom.active.begin(), freedom.active.end(), kParameters);
  const std::vector<Index> common(freedom.active.begin(), own);
  const auto count = static_cast<Index>(common.size());
  out.covariance = Eigen::MatrixXd::Zero(kParameters, kParameters);
  out.covariance(common, common) = covariance.topLeftCorner(count, count);
}

/// A linearisation costs a run per parameter: six damped steps are tried on one. The search ends
/// with a step that gains half a nat, a tenth of what decides between causes, or a millionth of the
/// cost, which is far less while the model is still wrong by 1e5 nat.
numerics::LevenbergMarquardtOptions Options(int most_steps) {
  return {.first_damping = 1e-4,
          .least_raised = 1e-3,
          .most_refused = 6,
          .most_steps = most_steps,
          .least_gain = 1.0,
          .least_relative_gain = 1e-6};
}

}  // namespace

Freedom FreedomOf(const Causes& causes, std::size_t records, const Theta& origin,
                  const Eigen::MatrixXd& known) {
  const std::size_t all = kParameters + records * kOwnParameters;
  Eigen::MatrixXd covariance = HealthyCovariance(all, known);
  std::vector<double> most(all);
  std::vector<double> least(all);
  for (std::size_t i = 0; i < all; ++i) {
    const auto at = static_cast<Index>(i);
    most[i] = kFarthest * std::sqrt(covariance(at, at));
    least[i] = std::max(LeastOf(i, origin), -most[i]);
  }
  Freedom freedom;
  for (const diagnosis::Hypothesis& cause : causes) {
    freedom.log_prior += cause.log_prior;
    for (const std::size_t i : cause.terms) {
      covariance(static_cast<Index>(i), static_cast<Index>(i)) += WideOf(i) * WideOf(i);
      most[i] = std::numeric_limits<double>::max();
      least[i] = LeastOf(i, origin);
      if (ToleranceOf(i) == 0.0 && least[i] == 0.0) ++freedom.one_sided;
    }
  }
  for (std::size_t i = 0; i < all; ++i) {
    if (covariance(static_cast<Index>(i), static_cast<Index>(i)) > 0.0) freedom.active.push_back(i);
  }
  const auto count = static_cast<Index>(freedom.active.size());
  freedom.deviation.resize(count);
  freedom.least.resize(count);
  freedom.most.resize(count);
  for (Index at = 0; at < count; ++at) {
    const std::size_t i = freedom.active[static_cast<std::size_t>(at)];
    freedom.deviation[at] = std::sqrt(covariance(static_cast<Index>(i), static_cast<Index>(i)));
    freedom.least[at] = least[i];
    freedom.most[at] = most[i];
  }
  freedom.precision = PrecisionOf(covariance, freedom);
  return freedom;
}

Fitted Fitter::Fit(const Causes& causes, const Theta& start, const Filters& filters,
                   int steps) const {
  const Freedom freedom =
      FreedomOf(causes, misfit_.series().size(), misfit_.rig().origin, misfit_.rig().known);
  Fitted out;
  out.theta = Zeros(misfit_.series().size());
  for (std::size_t i = 0; i < freedom.active.size(); ++i) {
    const auto at = static_cast<Index>(i);
    out.theta[freedom.active[i]] =
        std::clamp(start[freedom.active[i]], freedom.least[at], freedom.most[at]);
  }
  PenalisedMisfit problem(misfit_, filters, freedom);
  auto from = problem.At(out.theta);
  // A curve that others held in check may leave every range without them.
  if (!std::isfinite(from.cost)) from = problem.At(Zeros(misfit_.series().size()));
  const auto found = numerics::LevenbergMarquardt(problem, std::move(from), Options(steps));
  out.theta = found.at.point;
  const double cost = found.at.cost;
  if (!std::isfinite(cost))
    throw BadInput(
        "driven with these records, the rig file's own coils and ball give no finite "
        "current or motion: are the units and columns those of the rig file?");
  // At the minimum the Jacobian of the last step is as good as a new one.
  const numerics::NormalEquations normal =
      WithPriors(problem.sums(), freedom, Scaled(freedom, out.theta));
  const Eigen::LLT<Eigen::MatrixXd> llt(normal.matrix);
  out.squared_sum = cost - Penalty(freedom, out.theta);
  out.evidence = -0.5 * cost - HalfLogDeterminant(llt) + PriorOf(freedom);
  SetPosterior(freedom,
               llt.solve(Eigen::MatrixXd::Identity(normal.matrix.rows(), normal.matrix.cols())),
               out);
  return out;
}

Filters Fitter::Noise() const {
  const Causes& everything = AllCauses();
  Theta theta = Zeros(misfit_.series().size());
  // Scaled alone at first: what is not explained yet is no noise.
  const Filters filters = misfit_.Whiten(theta, 0);
  constexpr int kSteps = 8;
  theta = Fit(everything, theta, filters, kSteps).theta;
  theta = Fit(everything, theta, misfit_.Whiten(theta, 0), kSteps).theta;
  return misfit_.Whiten(theta, kMemory);
}

std::vector<double> Fitter::Screen(const Causes& causes, const Fitted& at,
                                   const Filters& filters) const {
  const std::size_t records = misfit_.series().size();
  std::vector<std::size_t> everything(at.theta.size());
  for (std::size_t i = 0; i < everything.size(); ++i) everything[i] = i;
  const Sums sums = misfit_.Linearise(at.theta, filters, everything);
  const auto evidence = [&](const Causes& set, bool& possible) {
    const Freedom freedom = FreedomOf(set, records, misfit_.rig().origin, misfit_.rig().known);
    const std::vector<Index> pick(freedom.active.begin(), freedom.active.end());
    const Sums part{sums.jtj(pick, pick), sums.jte(pick), sums.ete, sums.values};
    const Eigen::VectorXd z = Scaled(freedom, at.theta);
    numerics::NormalEquations normal = WithPriors(part, freedom, z);
    Freeze(freedom, z, normal);
    const Eigen::LLT<Eigen::MatrixXd> llt(normal.matrix);
    const Eigen::VectorXd step = -llt.solve(normal.gradient);
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
    const double predicted = sums.ete + z.dot(freedom.precision * z) + step.dot(normal.gradient);
    return -0.5 * predicted - HalfLogDeterminant(llt) + PriorOf(freedom);
  };
  bool possible = true;
  const double base = evidence(causes, possible);
  std::vector<double> gain;
  for (const diagnosis::Hypothesis& cause : AllCauses()) {
    Causes with = causes;
    with.push_back(cause);
    const double value = evidence(with, possible);
    gain.push_back(possible ? value - base : -std::numeric_limits<double>::infinity());
  }
  return gain;
}

}  // namespace levitas::levitator
