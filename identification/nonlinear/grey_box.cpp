#include "identification/nonlinear/grey_box.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>

#include "common/problem.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"
#include "numerics/dense/spectrum.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

std::vector<Feature> Terms(const WindowLayout& at, const OscillatorOptions& options) {
  std::vector<Feature> terms{{}};
  for (Index i = 1; i <= options.order; ++i) terms.push_back({.factors = {at.y(0, i)}});
  for (Index j = 0; j <= options.order; ++j) terms.push_back({.factors = {at.u(0, j)}});
  for (int degree = 2; degree <= options.degree; ++degree) {
    for (int second = 0; second <= (options.rate ? degree : 0); ++second) {
      Feature feature;
      feature.factors.assign(static_cast<std::size_t>(degree - second), at.y(0, 1));
      feature.factors.insert(feature.factors.end(), static_cast<std::size_t>(second), at.y(0, 2));
      terms.push_back(feature);
    }
  }
  return terms;
}

/// One-step least squares, by normal equations: the terms are few.
Eigen::VectorXd OneStep(const LaggedModel& model, const Series& series) {
  const Eigen::MatrixXd input = series.input / model.input_scale[0];
  const Eigen::MatrixXd output = series.output / model.output_scale[0];
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(series.rows(), 1);
  const auto n = static_cast<Index>(model.features[0].size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd window(model.layout.size());
  Eigen::VectorXd row(n);
  for (Index k = model.layout.Memory(); k < series.rows(); ++k) {
    FillWindow(model, input, output, none, k, window);
    for (Index j = 0; j < n; ++j) {
      row[j] = model.features[0][static_cast<std::size_t>(j)].Value(window);
    }
    normal += row * row.transpose();
    right += output(k, 0) * row;
  }
  return normal.ldlt().solve(right);
}

void ReadLinearPart(const LaggedModel& model, Index order, double period_s, Oscillator& result) {
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  companion.row(0) = model.theta[0].segment(1, order).transpose();
  companion.bottomLeftCorner(order - 1, order - 1).setIdentity();
  const Eigen::VectorXcd poles = numerics::EigenvaluesOf(companion);
  // The slowest pair: with an order to spare, pairs near half the sampling rate only shape noise.
  for (Index i = 0; i < order; ++i) {
    const std::complex<double> s = std::log(poles[i]) / period_s;
    const double frequency_hz = std::abs(s) / (2.0 * std::numbers::pi);
    if (std::abs(s.imag()) < 1e-9 * std::abs(s)) continue;
    if (result.frequency_hz > 0.0 && frequency_hz >= result.frequency_hz) continue;
    result.frequency_hz = frequency_hz;
    result.damping_ratio = -s.real() / std::abs(s);
  }
}

/// At rest every lag of a signal is the same number.
void ReadSpring(const LaggedModel& model, const OscillatorOptions& options, Oscillator& result) {
  result.spring = Eigen::VectorXd::Zero(std::max(options.degree, 1) + 1);
  double gain = 0.0;
  const double y_scale = model.output_scale[0];
  for (std::size_t j = 0; j < model.features[0].size(); ++j) {
    const auto& factors = model.features[0][j].factors;
    const double theta = model.theta[0][static_cast<Index>(j)] * y_scale;
    if (factors.size() == 1 && factors[0] >= model.layout.input_at()) {
      gain += theta / model.input_scale[0];
    } else {
      const auto power = static_cast<double>(factors.size());
      result.spring[static_cast<Index>(factors.size())] -= theta / std::pow(y_scale, power);
    }
  }
  result.spring[1] += 1.0;
  result.spring /= gain;
}

}  // namespace

Oscillator FitOscillator(const Series& series, const OscillatorOptions& options) {
  const WindowLayout layout{.outputs = 1,
                            .inputs = 1,
                            .output_lags = options.order,
                            .input_lags = options.order + 1,
                            .input_delay = 0,
                            .error_lags = 0};
  LaggedModel start = EmptyModel(layout, series);
  start.features[0] = Terms(layout, options);
  RefuseUnfit(series, start.features[0].size());
  start.theta[0] = OneStep(start, series);
  Oscillator result{RefineFreeRun(start, series, options.refine), 0.0, 0.0, {}};
  if (!std::isfinite(result.fit.rms_after)) {
    throw BadInput(
        "the model of one step does not run by itself: the data do not look like an oscillator of "
        "this order and degree");
  }
  ReadLinearPart(result.fit.model, options.order, series.period_s, result);
  ReadSpring(result.fit.model, options, result);
  return result;
}

}  // namespace levitas::identification
