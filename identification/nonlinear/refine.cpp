#include "identification/nonlinear/refine.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "identification/nonlinear/diverged.hpp"
#include "numerics/dense/factorisations.hpp"
#include "numerics/minimum/levenberg_marquardt.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

/// Sum of squares of the free run, and with `derive` its normal equations (lower triangle).
struct Evaluation {
  double squares{};
  Index count{};
  numerics::NormalEquations equations;
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

/// Gathers rows of sensitivities, so that the normal equations grow by many of them at once: faster
/// than row by row where there are hundreds of unknowns.
class Gathered {
 public:
  explicit Gathered(Index unknowns) : rows_(unknowns, kTogether), residual_(kTogether) {}

  void Add(const Eigen::Ref<const Eigen::VectorXd>& sensitivity, double residual,
           numerics::NormalEquations& sums) {
    rows_.col(count_) = sensitivity;
    residual_[count_] = residual;
    if (++count_ == kTogether) Flush(sums);
  }
  void Flush(numerics::NormalEquations& sums) {
    sums.matrix.selfadjointView<Eigen::Lower>().rankUpdate(rows_.leftCols(count_));
    sums.gradient.noalias() -= rows_.leftCols(count_) * residual_.head(count_);
    count_ = 0;
  }

 private:
  static constexpr Index kTogether = 64;
  Eigen::MatrixXd rows_;
  Eigen::VectorXd residual_;
  Index count_{};
};

class FreeRun {
 public:
  FreeRun(const Series& series, const LaggedModel& start, Index skip)
      : input_(series.input * start.input_scale.cwiseInverse().asDiagonal()),
        measured_(series.output * start.output_scale.cwiseInverse().asDiagonal()),
        none_(Eigen::MatrixXd::Zero(series.rows(), start.layout.outputs)),
        skip_(std::max(skip, start.layout.Memory())) {}

  /// One step of the minimisation, and the normal equations, for numerics::LevenbergMarquardt.
  [[nodiscard]] numerics::Iterate<LaggedModel> Step(const LaggedModel& from,
                                                    const Eigen::VectorXd& step) const {
    LaggedModel moved = Moved(from, step);
    const double squares = Evaluate(moved, false).squares;
    return {std::move(moved), squares};
  }
  [[nodiscard]] std::optional<numerics::NormalEquations> Linearise(
      const numerics::Iterate<LaggedModel>& at) const {
    return Evaluate(at.point, true).equations;
  }

  [[nodiscard]] Evaluation Evaluate(const LaggedModel& model, bool derive) const {
    const WindowLayout& at = model.layout;
    const Index unknowns = model.unknowns();
    Evaluation sums;
    if (derive) {
      sums.equations = {Eigen::MatrixXd::Zero(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns)};
    }
    Eigen::MatrixXd output = measured_;
    Eigen::VectorXd window(at.size());
    // Sensitivities of the last `output_lags` rows, as a ring: unknowns x outputs each.
    // A model of inputs alone has no use for them, and a ring of one.
    const Index kept = std::max<Index>(at.output_lags, 1);
    std::vector<Eigen::MatrixXd> ring(static_cast<std::size_t>(kept),
                                      Eigen::MatrixXd::Zero(unknowns, derive ? at.outputs : 0));
    Eigen::MatrixXd now(unknowns, derive ? at.outputs : 0);
    Gathered gathered(derive ? unknowns : 0);
    for (Index k = at.Memory(); k < output.rows(); ++k) {
      FillWindow(model, input_, output, none_, k, window);
      Index first = 0;
      for (Index o = 0; o < at.outputs; ++o) {
        output(k, o) = Predict(model, o, window, derive, k, first, ring, now);
        first += model.theta[static_cast<std::size_t>(o)].size();
      }
      if (!(output.row(k).cwiseAbs().maxCoeff() < kDivergedScales)) {
        sums.squares = std::numeric_limits<double>::infinity();
        return sums;
      }
      if (derive) ring[static_cast<std::size_t>(k % kept)] = now;
      if (k < skip_) continue;
      for (Index o = 0; o < at.outputs; ++o) {
        const double residual = measured_(k, o) - output(k, o);
        sums.squares += residual * residual;
        ++sums.count;
        if (derive) gathered.Add(now.col(o), residual, sums.equations);
      }
    }
    if (derive) gathered.Flush(sums.equations);
    return sums;
  }

 private:
  /// Prediction of one output; with `derive` its sensitivities go into a column of `now`.
  static double Predict(const LaggedModel& model, Index o, const Eigen::VectorXd& window,
                        bool derive, Index k, Index first, const std::vector<Eigen::MatrixXd>& ring,
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

}  // namespace

Refinement RefineFreeRun(const LaggedModel& start, const Series& series,
                         const RefineOptions& options) {
  FreeRun run(series, start, options.skip);
  const auto rms = [](const Evaluation& sums) {
    return std::sqrt(sums.squares / std::max(1.0, static_cast<double>(sums.count)));
  };
  const Evaluation before = run.Evaluate(start, false);
  auto found = numerics::LevenbergMarquardt(
      run, numerics::Iterate<LaggedModel>{start, before.squares},
      {.most_steps = options.most_iterations, .least_relative_gain = options.least_gain});
  const Evaluation after = run.Evaluate(found.at.point, true);
  Refinement result{std::move(found.at.point), rms(before), rms(after), {}, found.steps, false};
  // No step helps at any damping: that is an optimum too.
  result.converged = found.end == numerics::SearchEnd::kConverged ||
                     found.end == numerics::SearchEnd::kNoStepHelps;
  if (std::isfinite(after.squares)) {
    const Eigen::MatrixXd full = after.equations.matrix.selfadjointView<Eigen::Lower>();
    const Index n = full.rows();
    const Eigen::MatrixXd covariance = full.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    result.deviation = covariance.diagonal().cwiseMax(0.0).cwiseSqrt() * result.rms_after;
  }
  return result;
}

}  // namespace levitas::identification
