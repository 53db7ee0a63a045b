#include "identification/nonlinear/hammerstein_wiener.hpp"

#include <fmt/core.h>

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/problem.hpp"
#include "identification/nonlinear/diverged.hpp"
#include "identification/nonlinear/laguerre.hpp"
#include "numerics/spectra/spectra.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr int kNewtonSteps = 20;

Eigen::VectorXd Scale(const Eigen::MatrixXd& m) {
  return (m.colwise().norm() / std::sqrt(static_cast<double>(std::max<Index>(1, m.rows()))))
      .cwiseMax(1e-300)
      .transpose();
}

/// Row of the numerators of power `degree` (from 1) of input `i`.
Index NumeratorAt(const HammersteinWienerModel& m, Index i, int degree) {
  return (m.outputs + i * m.options.degree + degree - 1) * m.options.order;
}

/// Row of the numerators of product `n` of axis `i`.
Index ProductAt(const HammersteinWienerModel& m, Index i, Index n) {
  return (m.outputs + m.inputs * m.options.degree + i * kProducts + n) * m.options.order;
}

Index NoiseAt(const HammersteinWienerModel& m) {
  return ProductAt(m, m.options.products ? m.inputs : 0, 0);
}

double LagOf(const HammersteinWienerModel& m) {
  const double hz = m.options.input_lag_hz;
  return hz > 0.0 ? std::exp(-2.0 * std::numbers::pi * hz * m.period_s) : 0.0;
}

/// Scaled, straightened outputs.
Eigen::VectorXd Straighten(const HammersteinWienerModel& m, const Eigen::VectorXd& y) {
  Eigen::VectorXd v(m.outputs);
  for (Index o = 0; o < m.outputs; ++o) v[o] = m.sensor(o).Invert(y[o]) / m.output_scale[o];
  return v;
}

Eigen::VectorXd Bend(const HammersteinWienerModel& m, const Eigen::VectorXd& v) {
  Eigen::VectorXd y(m.outputs);
  for (Index o = 0; o < m.outputs; ++o) y[o] = m.sensor(o).Read(v[o] * m.output_scale[o]);
  return y;
}

/// Rows whose measured outputs fill the banks before a free run.
Index Warm(const HammersteinWienerModel& m) { return 2 * m.options.order; }

}  // namespace

double SensorCharacteristic::Invert(double y) const noexcept {
  double x = y;
  for (int n = 0; n < kNewtonSteps; ++n) {
    const double slope = 1.0 + x * (2.0 * a2 + 3.0 * a3 * x);
    if (!(slope > 0.0)) break;
    const double step = (y - Read(x)) / slope;
    x += step;
    if (std::abs(step) <= 1e-16 * std::abs(x)) break;
  }
  return x;
}

Index HammersteinWienerModel::regressors() const noexcept {
  return NoiseAt(*this) + outputs * options.noise_order + 1;
}

SensorCharacteristic HammersteinWienerModel::sensor(Index output) const {
  return options.sensors.empty() ? SensorCharacteristic{}
                                 : options.sensors[static_cast<std::size_t>(output)];
}

std::vector<InputCurve> Curves(const HammersteinWienerModel& m) {
  std::vector<InputCurve> curves;
  curves.reserve(static_cast<std::size_t>(m.inputs));
  const Index n = m.options.order;
  for (Index i = 0; i < m.inputs; ++i) {
    Eigen::MatrixXd stack(n * m.outputs, m.options.degree);
    for (int d = 1; d <= m.options.degree; ++d) {
      const Eigen::MatrixXd block = m.theta.middleRows(NumeratorAt(m, i, d), n);
      stack.col(d - 1) = Eigen::Map<const Eigen::VectorXd>(block.data(), block.size());
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(stack, Eigen::ComputeThinV);
    const Eigen::VectorXd first = svd.matrixV().col(0);
    const double squares = svd.singularValues().squaredNorm();
    curves.push_back(
        {first / first[0], squares > 0.0 ? std::pow(svd.singularValues()[0], 2) / squares : 0.0});
  }
  return curves;
}

HammersteinWienerState::HammersteinWienerState(const HammersteinWienerModel& model)
    : phi_(Eigen::VectorXd::Zero(model.regressors())),
      lagged_(Eigen::VectorXd::Zero(model.inputs)),
      pending_(Eigen::MatrixXd::Zero(model.inputs, model.options.input_delay)) {
  phi_[phi_.size() - 1] = 1.0;
}

void HammersteinWienerState::Push(const HammersteinWienerModel& m, const Eigen::VectorXd& v,
                                  const Eigen::VectorXd& u, const Eigen::VectorXd& eps) noexcept {
  const Index n = m.options.order;
  for (Index o = 0; o < m.outputs; ++o) PushLaguerre(m.pole, v[o], phi_.segment(o * n, n));
  for (Index i = 0; i < m.inputs; ++i) {
    const double scaled = u[i] / m.input_scale[i];
    double power = 1.0;
    for (int d = 1; d <= m.options.degree; ++d) {
      power *= scaled;
      PushLaguerre(m.pole, power, phi_.segment(NumeratorAt(m, i, d), n));
    }
  }
  if (m.options.products) PushProducts(m, v, u);
  const Index noise = m.options.noise_order;
  for (Index o = 0; o < m.outputs; ++o) {
    PushLaguerre(m.pole, eps[o], phi_.segment(NoiseAt(m) + o * noise, noise));
  }
}

void HammersteinWienerState::PushProducts(const HammersteinWienerModel& m, const Eigen::VectorXd& v,
                                          const Eigen::VectorXd& u) noexcept {
  const double lag = LagOf(m);
  const Index delay = pending_.cols();
  for (Index k = 0; k < m.inputs; ++k) {
    const double i = lagged_[k];
    const double x = v[k];
    const std::array<double, kProducts> products{i * i * x, i * x * x, x * x * x, i * i * i};
    for (Index n = 0; n < kProducts; ++n) {
      PushLaguerre(m.pole, products[static_cast<std::size_t>(n)],
                   phi_.segment(ProductAt(m, k, n), m.options.order));
    }
    const double now = u[k] / m.input_scale[k];
    lagged_[k] = lag * i + (1.0 - lag) * (delay > 0 ? pending_(k, 0) : now);
    for (Index d = 0; d + 1 < delay; ++d) pending_(k, d) = pending_(k, d + 1);
    if (delay > 0) pending_(k, delay - 1) = now;
  }
}

void HammersteinWienerState::Clear() noexcept {
  phi_.setZero();
  phi_[phi_.size() - 1] = 1.0;
  lagged_.setZero();
  pending_.setZero();
}

Index MemoryRows(const HammersteinWienerModel& model) {
  const Index sections = std::max(model.options.order, model.options.noise_order);
  Eigen::VectorXd bank = Eigen::VectorXd::Zero(sections);
  PushLaguerre(model.pole, 1.0, bank);
  Index rows = 0;
  for (; bank.norm() > kForgotten; ++rows) PushLaguerre(model.pole, 0.0, bank);
  if (!model.options.products) return rows;
  // An input goes through delay and lag before the banks of the products see it.
  const double lag = LagOf(model);
  const double decay = lag > 0.0 ? std::ceil(std::log(kForgotten) / std::log(lag)) : 0.0;
  return rows + model.options.input_delay + static_cast<Index>(decay) + 1;
}

RecursiveHammersteinWiener::RecursiveHammersteinWiener(HammersteinWienerModel start,
                                                       double start_variance)
    : model_(std::move(start)),
      state_(model_),
      p_(Eigen::MatrixXd::Identity(model_.regressors(), model_.regressors()) * start_variance),
      gain_(Eigen::VectorXd::Zero(model_.regressors())),
      v_(Eigen::VectorXd::Zero(model_.outputs)),
      error_(Eigen::VectorXd::Zero(model_.outputs)),
      posterior_(Eigen::VectorXd::Zero(model_.outputs)) {}

const Eigen::VectorXd& RecursiveHammersteinWiener::Step(const Eigen::VectorXd& u,
                                                        const Eigen::VectorXd& y) noexcept {
  if (!u.allFinite() || !y.allFinite()) {
    ++skipped_;
    return error_;
  }
  Straighten(y);
  const Eigen::VectorXd& phi = state_.phi();
  error_.noalias() = v_ - model_.theta.transpose() * phi;
  gain_.noalias() = p_.selfadjointView<Eigen::Lower>() * phi;
  const double weight = model_.options.forgetting + phi.dot(gain_);
  model_.theta.noalias() += (gain_ / weight) * error_.transpose();
  p_.selfadjointView<Eigen::Lower>().rankUpdate(gain_, -1.0 / weight);
  if (model_.options.forgetting < 1.0) p_ /= model_.options.forgetting;
  posterior_.noalias() = v_ - model_.theta.transpose() * phi;
  state_.Push(model_, v_, u, posterior_);
  return error_;
}

void RecursiveHammersteinWiener::Straighten(const Eigen::VectorXd& y) noexcept {
  for (Index o = 0; o < model_.outputs; ++o) {
    v_[o] = model_.sensor(o).Invert(y[o]) / model_.output_scale[o];
  }
}

void RecursiveHammersteinWiener::Restart() noexcept { state_.Clear(); }

void RecursiveHammersteinWiener::Fill(const Eigen::VectorXd& u, const Eigen::VectorXd& y) noexcept {
  Straighten(y);
  posterior_.setZero();
  state_.Push(model_, v_, u, posterior_);
}

HammersteinWienerModel EmptyHammersteinWiener(const Series& series,
                                              const HammersteinWienerOptions& options) {
  HammersteinWienerModel model{series.inputs(),
                               series.outputs(),
                               options,
                               series.period_s,
                               LaguerrePole(options.bandwidth_hz, series.period_s),
                               Scale(series.input),
                               Scale(series.output),
                               {}};
  model.theta = Eigen::MatrixXd::Zero(model.regressors(), model.outputs);
  return model;
}

HammersteinWienerFit FitHammersteinWiener(const Series& series,
                                          const HammersteinWienerOptions& options) {
  if (options.products && series.inputs() != series.outputs()) {
    throw BadInput(
        fmt::format("{} inputs and {} outputs: products need current and position of the same axes",
                    series.inputs(), series.outputs()));
  }
  HammersteinWienerFit fit{EmptyHammersteinWiener(series, options), 0, 0.0};
  RefuseUnfit(series, static_cast<std::size_t>(fit.model.regressors()));
  do {
    RecursiveHammersteinWiener recursion(fit.model, options.start_variance);
    for (Index k = 0; k < series.rows(); ++k) {
      (void)recursion.Step(series.input.row(k), series.output.row(k));
    }
    fit.change = 0.0;
    const Eigen::MatrixXd& now = recursion.model().theta;
    for (Index o = 0; o < fit.model.outputs; ++o) {
      const double largest = now.col(o).cwiseAbs().maxCoeff();
      const double change = (now.col(o) - fit.model.theta.col(o)).cwiseAbs().maxCoeff();
      fit.change = std::max(fit.change, change / std::max(largest, 1e-300));
    }
    fit.model.theta = now;
    ++fit.passes;
  } while (fit.change > options.tolerance && fit.passes < options.most_passes);
  return fit;
}

Prediction PredictOneStep(const HammersteinWienerModel& model, const Series& series) {
  HammersteinWienerState state(model);
  Prediction result{Eigen::MatrixXd(series.rows(), model.outputs)};
  for (Index k = 0; k < series.rows(); ++k) {
    const Eigen::VectorXd v = Straighten(model, series.output.row(k).transpose());
    const Eigen::VectorXd predicted = model.theta.transpose() * state.phi();
    result.output.row(k) = Bend(model, predicted).transpose();
    state.Push(model, v, series.input.row(k).transpose(), v - predicted);
  }
  return result;
}

Prediction PredictAhead(const HammersteinWienerModel& model, const Series& series, Index steps,
                        Index from) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.outputs);
  HammersteinWienerState state(model);
  Prediction result{series.output};
  // `state` has seen all rows before `origin`; a copy of it goes on without measured outputs.
  for (Index origin = 0; origin < series.rows(); ++origin) {
    // The first origin also serves the rows that have less than `steps` rows before them.
    const Index reached = origin + steps - 1;
    const Index first = origin == 0 ? std::max<Index>(0, from) : std::max(from, reached);
    if (first <= std::min(reached, series.rows() - 1)) {
      HammersteinWienerState ahead = state;
      for (Index row = origin; row <= std::min(reached, series.rows() - 1); ++row) {
        const Eigen::VectorXd v = model.theta.transpose() * ahead.phi();
        const bool left = !(v.cwiseAbs().maxCoeff() < kDivergedScales);
        if (left && row >= first && !result.diverged_at) result.diverged_at = row;
        if (row >= first) result.output.row(row) = Bend(model, left ? none : v).transpose();
        ahead.Push(model, left ? none : v, series.input.row(row).transpose(), none);
      }
    }
    const Eigen::VectorXd v = Straighten(model, series.output.row(origin).transpose());
    const Eigen::VectorXd predicted = model.theta.transpose() * state.phi();
    state.Push(model, v, series.input.row(origin).transpose(), v - predicted);
  }
  return result;
}

Prediction SimulateFreeRun(const HammersteinWienerModel& model, const Series& series,
                           const Feedback& feedback) {
  HammersteinWienerState state(model);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.outputs);
  Prediction result{series.output};
  Eigen::VectorXd u(model.inputs);
  const Index warm = feedback ? 0 : std::min(Warm(model), series.rows());
  for (Index k = 0; k < series.rows(); ++k) {
    Eigen::VectorXd v = model.theta.transpose() * state.phi();
    if (k < warm) v = Straighten(model, series.output.row(k).transpose());
    if (!(v.cwiseAbs().maxCoeff() < kDivergedScales)) {
      result.diverged_at = k;
      result.output.bottomRows(series.rows() - k).setZero();
      break;
    }
    const Eigen::VectorXd y = Bend(model, v);
    result.output.row(k) = y.transpose();
    u = series.input.row(k).transpose();
    if (feedback) feedback(k, y, u);
    state.Push(model, v, u, none);
  }
  return result;
}

}  // namespace levitas::identification
