#include "identification/nonlinear/refine.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr double kDivergedScales = 1000.0;

/// Sum of squares of the free run, and with `derive` its normal equations.
struct Normal {
  double squares{};
  Index count{};
  Eigen::MatrixXd jtj;
  Eigen::VectorXd jtr;
};

class FreeRun {
 public:
  FreeRun(const Series& series, const LaggedModel& start, Index skip)
      : input_(series.input * start.input_scale.cwiseInverse().asDiagonal()),
        measured_(series.output * start.output_scale.cwiseInverse().asDiagonal()),
        none_(Eigen::MatrixXd::Zero(series.rows(), start.layout.outputs)),
        skip_(std::max(skip, start.layout.Memory())) {}

  [[nodiscard]] Normal Evaluate(const LaggedModel& model, bool derive) const {
    const WindowLayout& at = model.layout;
    const Index unknowns = model.unknowns();
    Normal normal;
    if (derive) {
      normal.jtj = Eigen::MatrixXd::Zero(unknowns, unknowns);
      normal.jtr = Eigen::VectorXd::Zero(unknowns);
    }
    Eigen::MatrixXd output = measured_;
    Eigen::VectorXd window(at.size());
    // Sensitivities of the last `output_lags` rows, as a ring: unknowns x outputs each.
    std::vector<Eigen::MatrixXd> ring(static_cast<std::size_t>(at.output_lags),
                                      Eigen::MatrixXd::Zero(unknowns, derive ? at.outputs : 0));
    Eigen::MatrixXd now(unknowns, derive ? at.outputs : 0);
    for (Index k = at.Memory(); k < output.rows(); ++k) {
      FillWindow(model, input_, output, none_, k, window);
      Index first = 0;
      for (Index o = 0; o < at.outputs; ++o) {
        output(k, o) = Step(model, o, window, derive, k, first, ring, now);
        first += model.theta[static_cast<std::size_t>(o)].size();
      }
      if (!(output.row(k).cwiseAbs().maxCoeff() < kDivergedScales)) {
        normal.squares = std::numeric_limits<double>::infinity();
        return normal;
      }
      if (derive) ring[static_cast<std::size_t>(k % at.output_lags)] = now;
      if (k < skip_) continue;
      for (Index o = 0; o < at.outputs; ++o) {
        const double residual = measured_(k, o) - output(k, o);
        normal.squares += residual * residual;
        ++normal.count;
        if (!derive) continue;
        normal.jtj.selfadjointView<Eigen::Lower>().rankUpdate(now.col(o));
        normal.jtr += residual * now.col(o);
      }
    }
    return normal;
  }

 private:
  /// Prediction of one output; with `derive` its sensitivities go into a column of `now`.
  static double Step(const LaggedModel& model, Index o, const Eigen::VectorXd& window, bool derive,
                     Index k, Index first, const std::vector<Eigen::MatrixXd>& ring,
                     Eigen::MatrixXd& now) {
    const WindowLayout& at = model.layout;
    const auto& features = model.features[static_cast<std::size_t>(o)];
    const Eigen::VectorXd& theta = model.theta[static_cast<std::size_t>(o)];
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(derive ? window.size() : 0);
    if (derive) now.col(o).setZero();
    double sum = 0.0;
    for (Index j = 0; j < theta.size(); ++j) {
      const Feature& feature = features[static_cast<std::size_t>(j)];
      const double value = feature.Value(window);
      sum += theta[j] * value;
      if (!derive) continue;
      now(first + j, o) = value;
      feature.AddGradient(window, theta[j], gradient);
    }
    for (Index other = 0; derive && other < at.outputs; ++other) {
      for (Index lag = 1; lag <= at.output_lags; ++lag) {
        const double slope = gradient[at.y(other, lag)];
        if (slope == 0.0 || k - lag < at.Memory()) continue;
        now.col(o) += slope * ring[static_cast<std::size_t>((k - lag) % at.output_lags)].col(other);
      }
    }
    return sum;
  }

  Eigen::MatrixXd input_, measured_, none_;
  Index skip_;
};

LaggedModel Moved(const LaggedModel& model, const Eigen::VectorXd& step) {
  LaggedModel moved = model;
  Index first = 0;
  for (Eigen::VectorXd& theta : moved.theta) {
    theta += step.segment(first, theta.size());
    first += theta.size();
  }
  return moved;
}

}  // namespace

Refinement RefineFreeRun(const LaggedModel& start, const Series& series,
                         const RefineOptions& options) {
  const FreeRun run(series, start, options.skip);
  Refinement result{start, 0.0, 0.0, {}, 0, false};
  Normal at = run.Evaluate(start, true);
  const auto rms = [](const Normal& n) {
    return std::sqrt(n.squares / std::max(1.0, static_cast<double>(n.count)));
  };
  result.rms_before = rms(at);
  double damping = 1e-3;
  while (std::isfinite(at.squares) && result.iterations < options.most_iterations &&
         damping < 1e12) {
    Eigen::MatrixXd system = at.jtj.selfadjointView<Eigen::Lower>();
    system.diagonal() *= 1.0 + damping;
    const LaggedModel trial = Moved(result.model, system.ldlt().solve(at.jtr));
    const double squares = run.Evaluate(trial, false).squares;
    if (!(squares < at.squares)) {
      damping *= 10.0;
      continue;
    }
    const double gain = 1.0 - squares / at.squares;
    result.model = trial;
    ++result.iterations;
    at = run.Evaluate(trial, true);
    damping *= 0.1;
    if (gain < options.least_gain) {
      result.converged = true;
      break;
    }
  }
  // No step helps at any damping: that is an optimum too.
  if (std::isfinite(at.squares) && damping >= 1e12) result.converged = true;
  result.rms_after = rms(at);
  if (std::isfinite(at.squares)) {
    const Eigen::MatrixXd full = at.jtj.selfadjointView<Eigen::Lower>();
    const Index n = full.rows();
    const Eigen::MatrixXd covariance = full.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    result.deviation = covariance.diagonal().cwiseMax(0.0).cwiseSqrt() * result.rms_after;
  }
  return result;
}

}  // namespace levitas::identification
