#include "identification/balance/unbalance_fit.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/factors/factors.hpp"
#include "numerics/minimum/levenberg_marquardt.hpp"

namespace levitas::balancing {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// Neighbouring windows share noise: their amplitudes are correlated by 1/6, each has two.
constexpr double kOverlap = 4.0 / 3.0;
/// ISO 21940-11: G 40 is what a crankshaft has; no rotor that runs on magnets has more.
constexpr double kLargestGradeMPerS = 0.04;

/// Of the reference: rounds at most, and the step [deviations of the unknowns] that settles it.
constexpr int kRounds = 20;
constexpr double kSettled = 0.02;
/// Earlier rounds that the next place is drawn from.
constexpr std::size_t kRemembered = 4;
/// Steps that mixing may add to the round's own.
constexpr double kFurthest = 5.0;
/// Of the stated deviations: no unknown of the rig is sought further off. Records that ask for more
/// contradict the rig or each other, and beyond it the rig may be none that can be built.
constexpr double kSought = 8.0;
/// Remainder, in squares over the noise's, that ends the rounds after the third: no rig near this
/// one explains the records.
constexpr double kHopeless = 100.0;

struct Trial {
  VectorXd place;
  VectorXcd amplitudes;
};

class FitProblem {
 public:
  explicit FitProblem(const Predictor& predictor) : predictor_(predictor) {
    const configuration::Tolerances by =
        predictor.rig().rig().tolerances.value_or(configuration::Tolerances{});
    runout_m_ = std::max(by.sensor_runout_m, 1e-9);
    for (const Unknown& unknown : predictor.rig().unknowns()) {
      deviation_.conservativeResize(deviation_.size() + 1);
      deviation_[deviation_.size() - 1] = unknown.deviation;
    }
    double fastest = 1.0;
    for (const auto& window : predictor.windows()) {
      fastest = std::max(fastest, std::abs(window.speed_rad_per_s));
    }
    size_kg_m_ = kLargestGradeMPerS / fastest * predictor.rig().mass_kg();
  }

  /// The amplitudes that fit best there.
  [[nodiscard]] numerics::Iterate<Trial> Solve(const VectorXd& place) const {
    Trial trial{place, {}};
    const auto equations = predictor_.At(place);
    MatrixXcd normal;
    VectorXcd right;
    AddUp(equations, normal, right);
    trial.amplitudes = -normal.llt().solve(right);
    double cost =
        (place.cwiseQuotient(deviation_)).squaredNorm() + trial.amplitudes.cwiseAbs2().dot(Prior());
    cost += DataCost(equations, trial.amplitudes);
    return {std::move(trial), cost};
  }

  [[nodiscard]] std::optional<numerics::NormalEquations> Linearise(
      const numerics::Iterate<Trial>& at) const {
    const auto equations = predictor_.At(at.point.place, at.point.amplitudes);
    const Sums sums = SumsOf(equations, at.point.amplitudes);
    numerics::NormalEquations made;
    const MatrixXcd taken = sums.across.adjoint() * sums.normal.llt().solve(sums.across);
    made.matrix = (sums.slopes - taken).real();
    made.gradient = sums.pull;
    made.matrix.diagonal() += deviation_.cwiseAbs2().cwiseInverse();
    made.gradient += at.point.place.cwiseQuotient(deviation_.cwiseAbs2());
    return made;
  }

  [[nodiscard]] numerics::Iterate<Trial> Step(const Trial& from, const VectorXd& step) const {
    // No further than six deviations at once, where the equations are no longer those of the step.
    const double longest = step.cwiseQuotient(deviation_).cwiseAbs().maxCoeff();
    return Solve(Sought(from.place + (longest > 6.0 ? 6.0 / longest : 1.0) * step));
  }

  [[nodiscard]] VectorXd Sought(const VectorXd& place) const {
    return place.cwiseMax(-kSought * deviation_).cwiseMin(kSought * deviation_);
  }

  /// The size of the planes' unbalance as this trial has it.
  void TakeSize(const Trial& trial) {
    MatrixXcd normal;
    VectorXcd right;
    AddUp(predictor_.At(trial.place), normal, right);
    const MatrixXcd spread = normal.llt().solve(MatrixXcd::Identity(normal.rows(), normal.cols()));
    const Index planes = predictor_.rig().planes();
    const double square = trial.amplitudes.head(planes).squaredNorm() +
                          2.0 * spread.diagonal().head(planes).real().sum();
    size_kg_m_ = std::max(std::sqrt(square / static_cast<double>(planes)), 1e-12);
  }

  /// Real ones, of all windows.
  [[nodiscard]] double EquationCount() const {
    return static_cast<double>(2 * predictor_.rig().axes()) *
           static_cast<double>(predictor_.windows().size());
  }
  [[nodiscard]] const VectorXd& deviation() const noexcept { return deviation_; }

  [[nodiscard]] UnbalanceFit Finish(const numerics::Iterate<Trial>& at) const;

 private:
  struct Sums {
    MatrixXcd normal;  ///< amplitudes, priors included
    MatrixXcd across;  ///< amplitudes x unknowns
    MatrixXcd slopes;  ///< unknowns x unknowns
    VectorXd pull;
  };

  /// 1/variance of each amplitude's real and imaginary part.
  [[nodiscard]] VectorXd Prior() const {
    const Index planes = predictor_.rig().planes();
    VectorXd prior(predictor_.amplitudes());
    prior.head(planes).setConstant(2.0 / (size_kg_m_ * size_kg_m_));
    prior.tail(prior.size() - planes).setConstant(1.0 / (runout_m_ * runout_m_));
    return prior;
  }

  void AddUp(const std::vector<WindowEquations>& equations, MatrixXcd& normal,
             VectorXcd& right) const {
    const Index n = predictor_.amplitudes();
    normal = MatrixXcd::Zero(n, n);
    right = VectorXcd::Zero(n);
    for (const WindowEquations& one : equations) {
      const auto columns = one.linear.rightCols(n);
      normal += columns.adjoint() * columns;
      right += columns.adjoint() * one.linear.col(0);
    }
    normal.diagonal() += Prior().cast<Complex>();
  }

  [[nodiscard]] double DataCost(const std::vector<WindowEquations>& equations,
                                const VectorXcd& amplitudes) const {
    double cost = 0.0;
    for (const WindowEquations& one : equations) {
      cost +=
          (one.linear.col(0) + one.linear.rightCols(amplitudes.size()) * amplitudes).squaredNorm();
    }
    return cost;
  }

  [[nodiscard]] Sums SumsOf(const std::vector<WindowEquations>& equations,
                            const VectorXcd& amplitudes) const {
    Sums sums;
    VectorXcd right;
    AddUp(equations, sums.normal, right);
    const Index n = amplitudes.size();
    const Index unknowns = deviation_.size();
    sums.across = MatrixXcd::Zero(n, unknowns);
    sums.slopes = MatrixXcd::Zero(unknowns, unknowns);
    sums.pull = VectorXd::Zero(unknowns);
    for (const WindowEquations& one : equations) {
      const auto columns = one.linear.rightCols(n);
      const VectorXcd r = one.linear.col(0) + columns * amplitudes;
      sums.across += columns.adjoint() * one.slopes;
      sums.slopes += one.slopes.adjoint() * one.slopes;
      sums.pull += (one.slopes.adjoint() * r).real();
    }
    return sums;
  }

  const Predictor& predictor_;
  VectorXd deviation_;
  double runout_m_{}, size_kg_m_{};
};

/// Stacks real above imaginary parts.
Eigen::MatrixXd Stacked(const MatrixXcd& m) {
  Eigen::MatrixXd out(2 * m.rows(), m.cols());
  out << m.real(), m.imag();
  return out;
}

UnbalanceFit FitProblem::Finish(const numerics::Iterate<Trial>& at) const {
  const auto equations = predictor_.At(at.point.place, at.point.amplitudes);
  const Sums sums = SumsOf(equations, at.point.amplitudes);
  const Index n = at.point.amplitudes.size();
  const Index planes = predictor_.rig().planes();
  const MatrixXcd inverse = sums.normal.llt().solve(MatrixXcd::Identity(n, n));
  const auto left = *Linearise(at);
  const Eigen::MatrixXd rig =
      left.matrix.ldlt().solve(Eigen::MatrixXd::Identity(deviation_.size(), deviation_.size()));
  UnbalanceFit fit;
  fit.windows = equations.size();
  fit.reduced_chi_square =
      DataCost(equations, at.point.amplitudes) / std::max(1.0, EquationCount());
  const double wider = kOverlap * std::max(1.0, fit.reduced_chi_square);
  // A circular part of the noise, and what the rig's unknowns leave.
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  all.topLeftCorner(n, n) = all.bottomRightCorner(n, n) = inverse.real();
  all.bottomLeftCorner(n, n) = inverse.imag();
  all.topRightCorner(n, n) = -inverse.imag();
  const Eigen::MatrixXd moved = Stacked(-inverse * sums.across);
  all += moved * rig * moved.transpose();
  all *= wider;
  fit.covariance.resize(2 * planes, 2 * planes);
  fit.covariance << all.topLeftCorner(planes, planes), all.block(0, n, planes, planes),
      all.block(n, 0, planes, planes), all.block(n, n, planes, planes);
  fit.runout_deviation_m = all.diagonal().segment(planes, n - planes).cwiseSqrt();
  fit.unbalance_kg_m = at.point.amplitudes.head(planes);
  fit.runout_m = at.point.amplitudes.tail(n - planes);
  fit.place = at.point.place;
  fit.place_deviation = (wider * rig.diagonal()).cwiseSqrt();
  fit.size_kg_m = size_kg_m_;
  return fit;
}

/// Where rounds lead that each make `step` of `from`: Anderson's mixing (J. ACM 12, 1965) of the
/// last few. A round alone goes on by a quarter of the way where the record says little of a
/// direction.
class Rounds {
 public:
  [[nodiscard]] VectorXd Next(const VectorXd& from, const VectorXd& step) {
    // A step longer than the one before: what is remembered led astray.
    if (!step_.empty() && step.norm() > step_.back().norm()) {
      from_.clear();
      step_.clear();
    }
    from_.push_back(from);
    step_.push_back(step);
    if (from_.size() > kRemembered) {
      from_.erase(from_.begin());
      step_.erase(step_.begin());
    }
    const auto count = static_cast<Index>(from_.size()) - 1;
    if (count == 0) return from + step;
    Eigen::MatrixXd steps(step.size(), count);
    Eigen::MatrixXd places(step.size(), count);
    for (Index i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      steps.col(i) = step_[at + 1] - step_[at];
      places.col(i) = from_[at + 1] - from_[at];
    }
    const VectorXd share = Eigen::MatrixXd(steps).colPivHouseholderQr().solve(step);
    const VectorXd further = (places + steps) * share;
    if (further.norm() > kFurthest * step.norm()) return from + step;
    return from + step - further;
  }

 private:
  std::vector<VectorXd> from_, step_;
};

}  // namespace

UnbalanceFit FitUnbalance(Predictor& predictor) {
  FitProblem problem(predictor);
  const VectorXd& deviation = problem.deviation();
  auto at = problem.Solve(VectorXd::Zero(deviation.size()));
  numerics::LevenbergMarquardtOptions options;
  options.most_steps = 30;
  options.most_trials = 60;
  options.least_gain = 1e-3;
  options.least_relative_gain = 1e-6;
  Rounds rounds;
  bool converged = false;
  // The size belongs to the amplitudes, the reference to the rig, and they to both.
  for (int round = 0; round < kRounds && !converged; ++round) {
    problem.TakeSize(at.point);
    const VectorXd from = at.point.place.cwiseQuotient(deviation);
    predictor.Refer(at.point.place, at.point.amplitudes);
    at = numerics::LevenbergMarquardt(problem, problem.Solve(at.point.place), options).at;
    const VectorXd step = at.point.place.cwiseQuotient(deviation) - from;
    converged = step.cwiseAbs().maxCoeff() < kSettled;
    if (round >= 2 && at.cost > kHopeless * problem.EquationCount()) break;
    if (!converged && round + 1 < kRounds)
      at = problem.Solve(problem.Sought(rounds.Next(from, step).cwiseProduct(deviation)));
  }
  UnbalanceFit fit = problem.Finish(at);
  fit.converged = converged;
  return fit;
}

}  // namespace levitas::balancing
