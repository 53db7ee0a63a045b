#include "identification/nonlinear/lagged_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "identification/nonlinear/diverged.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

std::string EntryName(const WindowLayout& at, Index entry) {
  if (entry < at.input_at()) {
    return fmt::format("y{}(k-{})", entry / at.output_lags + 1, entry % at.output_lags + 1);
  }
  if (entry < at.error_at()) {
    const Index n = entry - at.input_at();
    const Index lag = n % at.input_lags + at.input_delay;
    return lag == 0 ? fmt::format("u{}(k)", n / at.input_lags + 1)
                    : fmt::format("u{}(k-{})", n / at.input_lags + 1, lag);
  }
  const Index n = entry - at.error_at();
  return fmt::format("e{}(k-{})", n / at.error_lags + 1, n % at.error_lags + 1);
}

Eigen::VectorXd Deviation(const Eigen::MatrixXd& m) {
  const Eigen::RowVectorXd mean = m.colwise().mean();
  return ((m.rowwise() - mean).colwise().norm() / std::sqrt(static_cast<double>(m.rows())))
      .cwiseMax(1e-300)
      .transpose();
}

double Evaluate(const LaggedModel& model, Index output, const Eigen::VectorXd& window) {
  const auto o = static_cast<std::size_t>(output);
  double sum = 0.0;
  for (std::size_t j = 0; j < model.features[o].size(); ++j) {
    sum += model.theta[o][static_cast<Index>(j)] * model.features[o][j].Value(window);
  }
  return sum;
}

Prediction Run(const LaggedModel& model, const Series& series, bool free_run) {
  const Eigen::MatrixXd input = series.input * model.input_scale.cwiseInverse().asDiagonal();
  Eigen::MatrixXd measured = series.output * model.output_scale.cwiseInverse().asDiagonal();
  Eigen::MatrixXd error = Eigen::MatrixXd::Zero(series.rows(), model.layout.outputs);
  Eigen::MatrixXd predicted = measured;
  Eigen::VectorXd window(model.layout.size());
  Prediction result;
  for (Index k = model.layout.Memory(); k < series.rows(); ++k) {
    FillWindow(model, input, free_run ? predicted : measured, error, k, window);
    for (Index o = 0; o < model.layout.outputs; ++o) {
      predicted(k, o) = Evaluate(model, o, window);
      if (!free_run) error(k, o) = measured(k, o) - predicted(k, o);
    }
    if (!(predicted.row(k).cwiseAbs().maxCoeff() < kDivergedScales)) {
      result.diverged_at = k;
      predicted.bottomRows(series.rows() - k).setZero();
      break;
    }
  }
  result.output = predicted * model.output_scale.asDiagonal();
  return result;
}

}  // namespace

Index WindowLayout::Memory() const noexcept {
  return std::max({output_lags, input_delay + input_lags - 1, error_lags});
}

double Feature::Value(const Eigen::VectorXd& window) const {
  if (weights.size() > 0) return std::tanh(bias + weights.dot(window));
  double product = 1.0;
  for (const Index f : factors) product *= window[f];
  return product;
}

void Feature::AddGradient(const Eigen::VectorXd& window, double scale,
                          Eigen::VectorXd& gradient) const {
  if (weights.size() > 0) {
    const double t = std::tanh(bias + weights.dot(window));
    gradient += scale * (1.0 - t * t) * weights;
    return;
  }
  for (std::size_t i = 0; i < factors.size(); ++i) {
    double product = scale;
    for (std::size_t j = 0; j < factors.size(); ++j) {
      if (j != i) product *= window[factors[j]];
    }
    gradient[factors[i]] += product;
  }
}

std::string FeatureName(const WindowLayout& layout, const Feature& feature) {
  if (feature.weights.size() > 0) return "tanh(..)";
  if (feature.factors.empty()) return "1";
  std::map<Index, int> powers;
  for (const Index f : feature.factors) ++powers[f];
  std::string text;
  for (const auto& [entry, power] : powers) {
    if (!text.empty()) text += ' ';
    text += EntryName(layout, entry);
    if (power > 1) text += fmt::format("^{}", power);
  }
  return text;
}

Index LaggedModel::unknowns() const noexcept {
  Index count = 0;
  for (const Eigen::VectorXd& t : theta) count += t.size();
  return count;
}

LaggedModel EmptyModel(const WindowLayout& layout, const Series& series) {
  LaggedModel model{layout, Deviation(series.output), Deviation(series.input), {}, {}};
  model.features.resize(static_cast<std::size_t>(layout.outputs));
  model.theta.resize(model.features.size());
  return model;
}

void FillWindow(const LaggedModel& model, const Eigen::MatrixXd& scaled_input,
                const Eigen::MatrixXd& scaled_output, const Eigen::MatrixXd& scaled_error, Index k,
                Eigen::VectorXd& window) {
  const WindowLayout& at = model.layout;
  Index n = 0;
  for (Index o = 0; o < at.outputs; ++o) {
    for (Index lag = 1; lag <= at.output_lags; ++lag) window[n++] = scaled_output(k - lag, o);
  }
  for (Index i = 0; i < at.inputs; ++i) {
    for (Index lag = 0; lag < at.input_lags; ++lag) {
      window[n++] = scaled_input(k - at.input_delay - lag, i);
    }
  }
  for (Index o = 0; o < at.outputs; ++o) {
    for (Index lag = 1; lag <= at.error_lags; ++lag) window[n++] = scaled_error(k - lag, o);
  }
}

Prediction PredictOneStep(const LaggedModel& model, const Series& series) {
  return Run(model, series, false);
}

Prediction SimulateFreeRun(const LaggedModel& model, const Series& series) {
  return Run(model, series, true);
}

Prediction PredictAhead(const LaggedModel& model, const Series& series, Index steps, Index from) {
  const Eigen::MatrixXd input = series.input * model.input_scale.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd measured = series.output * model.output_scale.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd one_step =
      PredictOneStep(model, series).output * model.output_scale.cwiseInverse().asDiagonal();
  // What a single prediction overwrites behind its origin, and puts back before the next one.
  Eigen::MatrixXd output = measured;
  Eigen::MatrixXd error = measured - one_step;
  Eigen::VectorXd window(model.layout.size());
  Prediction result{series.output};
  for (Index k = std::max(from, model.layout.Memory()); k < series.rows(); ++k) {
    const Index first = std::max(model.layout.Memory(), k - steps + 1);
    bool left = false;
    for (Index row = first; row <= k && !left; ++row) {
      FillWindow(model, input, output, error, row, window);
      for (Index o = 0; o < model.layout.outputs; ++o) output(row, o) = Evaluate(model, o, window);
      error.row(row).setZero();
      left = !(output.row(row).cwiseAbs().maxCoeff() < kDivergedScales);
    }
    if (left) {
      if (!result.diverged_at) result.diverged_at = k;
      output.row(k).setZero();
    }
    result.output.row(k) = output.row(k).cwiseProduct(model.output_scale.transpose());
    const Index rows = k - first + 1;
    output.middleRows(first, rows) = measured.middleRows(first, rows);
    error.middleRows(first, rows) = (measured - one_step).middleRows(first, rows);
  }
  return result;
}

Eigen::VectorXd FitPercent(const Eigen::MatrixXd& measured, const Eigen::MatrixXd& predicted,
                           Index skip) {
  const Index rows = measured.rows() - skip;
  const auto centred = [&](const Eigen::MatrixXd& m) -> Eigen::MatrixXd {
    const Eigen::MatrixXd part = m.bottomRows(rows);
    return part.rowwise() - part.colwise().mean();
  };
  const Eigen::MatrixXd y = centred(measured);
  const Eigen::MatrixXd p = centred(predicted);
  return 100.0 * (1.0 - (y - p).colwise().norm().array() / y.colwise().norm().array()).transpose();
}

Eigen::VectorXd RmsError(const Eigen::MatrixXd& measured, const Eigen::MatrixXd& predicted,
                         Index skip) {
  const Index rows = measured.rows() - skip;
  return ((measured - predicted).bottomRows(rows).colwise().norm() /
          std::sqrt(static_cast<double>(rows)))
      .transpose();
}

}  // namespace levitas::identification
