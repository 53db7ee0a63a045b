#pragma once
// A discrete model y_k = sum_j theta_j f_j(w_k) of past outputs, inputs and, for noise models, past
// prediction errors: the family of NARX and NARMAX (Billings 2013, ch. 2; Chen & Billings 1989).
//
// Window   w_k holds y_o,k-1 .. y_o,k-ny of every output, u_i,k-d .. u_i,k-d-nu+1 of every input
//          and e_o,k-1 .. e_o,k-ne, each divided by its channel's scale.
// Feature  a product of entries of w (none: the constant 1), or tanh(bias + weights . w).
// One step the window holds measured outputs; errors are those of the predictions before.
// Free run the window holds the model's own outputs and no errors: what the model knows by itself.
//          The first `Memory()` rows are measured ones. A run whose output exceeds 1000 scales has
//          diverged: it is cut there and `diverged_at` says where.
// Thread   any; no shared state.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "identification/nonlinear/series.hpp"

namespace levitas::identification {

struct WindowLayout {
  Eigen::Index outputs{1}, inputs{1};
  Eigen::Index output_lags{2};
  Eigen::Index input_lags{2};
  Eigen::Index input_delay{1};  ///< 0: the input of the same sample counts
  Eigen::Index error_lags{0};

  [[nodiscard]] Eigen::Index input_at() const noexcept { return outputs * output_lags; }
  [[nodiscard]] Eigen::Index error_at() const noexcept { return input_at() + inputs * input_lags; }
  [[nodiscard]] Eigen::Index size() const noexcept { return error_at() + outputs * error_lags; }
  /// Rows before the first that can be predicted.
  [[nodiscard]] Eigen::Index Memory() const noexcept;
  /// Entry of w: y of channel `o`, lag from 1; u of channel `i`, lag from `input_delay`.
  [[nodiscard]] Eigen::Index y(Eigen::Index o, Eigen::Index lag) const noexcept {
    return o * output_lags + lag - 1;
  }
  [[nodiscard]] Eigen::Index u(Eigen::Index i, Eigen::Index lag) const noexcept {
    return input_at() + i * input_lags + lag - input_delay;
  }
};

struct Feature {
  std::vector<Eigen::Index> factors{};  ///< entries of w, repeated for powers
  Eigen::VectorXd weights{};            ///< not empty: a ridge function, factors unused
  double bias{};

  [[nodiscard]] double Value(const Eigen::VectorXd& window) const;
  /// Adds scale * d value / d w.
  void AddGradient(const Eigen::VectorXd& window, double scale, Eigen::VectorXd& gradient) const;
};

/// "y1(k-1)^2 u1(k-2)", "1", "tanh(..)".
[[nodiscard]] std::string FeatureName(const WindowLayout& layout, const Feature& feature);

struct LaggedModel {
  WindowLayout layout;
  Eigen::VectorXd output_scale, input_scale;
  std::vector<std::vector<Feature>> features;  ///< per output
  std::vector<Eigen::VectorXd> theta;          ///< per output, in scaled outputs

  [[nodiscard]] Eigen::Index unknowns() const noexcept;
};

/// Scales: standard deviation of every column.
[[nodiscard]] LaggedModel EmptyModel(const WindowLayout& layout, const Series& series);

/// Fills what the window of row k has of inputs, and of outputs and errors as given (rows x
/// outputs, scaled).
void FillWindow(const LaggedModel& model, const Eigen::MatrixXd& scaled_input,
                const Eigen::MatrixXd& scaled_output, const Eigen::MatrixXd& scaled_error,
                Eigen::Index k, Eigen::VectorXd& window);

struct Prediction {
  Eigen::MatrixXd output;  ///< rows x outputs, in the units of the series
  std::optional<Eigen::Index> diverged_at{};
};

[[nodiscard]] Prediction PredictOneStep(const LaggedModel& model, const Series& series);
[[nodiscard]] Prediction SimulateFreeRun(const LaggedModel& model, const Series& series);
/// Rows from `from` on, each from what was measured of outputs up to `steps` rows before it and of
/// inputs up to itself; 1 is one step, as many as there are rows the free run with measured inputs.
/// Rows before `from` are measured ones. Cost: rows x steps.
[[nodiscard]] Prediction PredictAhead(const LaggedModel& model, const Series& series,
                                      Eigen::Index steps, Eigen::Index from);

/// 100 (1 - |(y - mean y) - (p - mean p)| / |y - mean y|) per output, from row `skip` on: the
/// measure of Chiu (2022).
[[nodiscard]] Eigen::VectorXd FitPercent(const Eigen::MatrixXd& measured,
                                         const Eigen::MatrixXd& predicted, Eigen::Index skip);
/// Root mean square of the difference, means included.
[[nodiscard]] Eigen::VectorXd RmsError(const Eigen::MatrixXd& measured,
                                       const Eigen::MatrixXd& predicted, Eigen::Index skip);

}  // namespace levitas::identification
