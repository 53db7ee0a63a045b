#pragma once
// Hammerstein-Wiener model by recursive extended least squares: static curve of each input, linear
// dynamics, known static characteristic of each output; coloured noise estimated beside them.
//
// Equation  v = w^-1(y) with w the known characteristic of the sensor;
//           v_t = Theta^T [Phi v; Phi u; Phi u^2; ..; Phi p; Phi eps; 1] + eps_t, Phi the Laguerre
//           bank, eps the prediction errors themselves (extended least squares). Chiu (2022), eqs.
//           (23)-(43), who uses lags (pole 0) and diagonal denominators; here all outputs share all
//           of v. K = P phi/(lambda + phi' P phi), Theta += K (v - Theta' phi)', P = (P - K phi'
//           P)/lambda.
// Products  p: i^2 v, i v^2, v^3 and i^3 of every input and the output of the same number, with i'
//           = (u - i)/tau the input behind its amplifier. A magnet's force has them: it depends on
//           current and position together. Only with `products`.
// Curves    powers of an input have numerators of their own; Curves() gives the nearest common
//           curve by the leading singular pair, and the share it explains.
// Scales    inputs and v are divided by constants, so that all of phi is of like size.
// Time      Step: fixed cost, (outputs + 2) n^2 for n regressors; no allocation.
// Thread    that of its owner. Failure: none; values that are not finite are counted and left out.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "identification/nonlinear/lagged_model.hpp"

namespace levitas::identification {

/// y = x + a2 x^2 + a3 x^3, monotonic over the sensor's range.
struct SensorCharacteristic {
  double a2{}, a3{};
  [[nodiscard]] double Read(double x) const noexcept { return x * (1.0 + x * (a2 + x * a3)); }
  /// Newton; exact to rounding within the range where the characteristic is monotonic.
  [[nodiscard]] double Invert(double y) const noexcept;
};

struct HammersteinWienerOptions {
  Eigen::Index order{6};        ///< of each bank
  Eigen::Index noise_order{2};  ///< of the banks of prediction errors
  int degree{3};                ///< of the input's curve; 1: linear
  double bandwidth_hz{};        ///< of the banks; 0: plain lags
  bool products{};              ///< inputs and outputs are current and position of the same axes
  double input_lag_hz{};        ///< with products: 1/(2 pi tau); 0: no lag
  Eigen::Index input_delay{};   ///< with products: samples until an input begins to act
  double forgetting{1.0};       ///< lambda
  double start_variance{1e4};   ///< P at the start, times the identity
  int most_passes{5};           ///< offline
  double tolerance{0.01};       ///< offline: largest relative change from pass to pass
  std::vector<SensorCharacteristic> sensors{};  ///< per output; empty: straight
};

/// Estimated parameters; sufficient to run the model.
struct HammersteinWienerModel {
  Eigen::Index inputs{}, outputs{};
  HammersteinWienerOptions options;
  double period_s{};
  double pole{};
  Eigen::VectorXd input_scale, output_scale;
  Eigen::MatrixXd theta;  ///< regressors x outputs

  [[nodiscard]] Eigen::Index regressors() const noexcept;
  [[nodiscard]] SensorCharacteristic sensor(Eigen::Index output) const;
};

/// Curve of an input: h(u) = u + sum_l a_l u^l in scaled inputs, and how much of the numerators of
/// all powers one common curve explains.
struct InputCurve {
  Eigen::VectorXd power;  ///< a_1 = 1, a_2, ...
  double share{};
};
[[nodiscard]] std::vector<InputCurve> Curves(const HammersteinWienerModel& model);

/// Products of an axis.
inline constexpr Eigen::Index kProducts = 4;

/// Banks of one model between samples.
class HammersteinWienerState {
 public:
  explicit HammersteinWienerState(const HammersteinWienerModel& model);
  [[nodiscard]] const Eigen::VectorXd& phi() const noexcept { return phi_; }
  /// Moves on by one sample: v and eps scaled, u as given.
  void Push(const HammersteinWienerModel& model, const Eigen::VectorXd& v, const Eigen::VectorXd& u,
            const Eigen::VectorXd& eps) noexcept;
  /// As before the first sample.
  void Clear() noexcept;

 private:
  void PushProducts(const HammersteinWienerModel& model, const Eigen::VectorXd& v,
                    const Eigen::VectorXd& u) noexcept;

  Eigen::VectorXd phi_;
  Eigen::VectorXd lagged_;   ///< i, scaled
  Eigen::MatrixXd pending_;  ///< inputs that do not act yet, scaled; oldest first
};

/// Samples after which nothing is left of what the banks held before, to kForgotten of its size.
inline constexpr double kForgotten = 1e-4;
[[nodiscard]] Eigen::Index MemoryRows(const HammersteinWienerModel& model);

/// Online: one sample after the other while the rig runs.
class RecursiveHammersteinWiener {
 public:
  RecursiveHammersteinWiener(HammersteinWienerModel start, double start_variance);
  /// `u` acts from the next sample on. Returns the prediction error of v, scaled.
  const Eigen::VectorXd& Step(const Eigen::VectorXd& u, const Eigen::VectorXd& y) noexcept;
  /// Samples are missing before the next one: the past of the signals is cleared, what was learnt
  /// stays.
  void Restart() noexcept;
  /// Moves on by one sample and learns nothing from it: after Restart, until the banks are filled.
  /// Prediction errors are taken as 0. Both must be finite.
  void Fill(const Eigen::VectorXd& u, const Eigen::VectorXd& y) noexcept;
  /// v of the last sample, scaled.
  [[nodiscard]] const Eigen::VectorXd& straightened() const noexcept { return v_; }
  [[nodiscard]] const HammersteinWienerModel& model() const noexcept { return model_; }
  [[nodiscard]] std::size_t skipped() const noexcept { return skipped_; }

 private:
  void Straighten(const Eigen::VectorXd& y) noexcept;

  HammersteinWienerModel model_;
  HammersteinWienerState state_;
  Eigen::MatrixXd p_;
  Eigen::VectorXd gain_, v_, error_, posterior_;
  std::size_t skipped_{};
};

/// Scales from the data, theta zero.
[[nodiscard]] HammersteinWienerModel EmptyHammersteinWiener(
    const Series& series, const HammersteinWienerOptions& options);

struct HammersteinWienerFit {
  HammersteinWienerModel model;
  int passes{};
  double change{};  ///< largest relative change of the last pass
};

/// Offline: passes over the same data until the coefficients stand still. BadInput by RefuseUnfit,
/// and with products when there are not as many inputs as outputs.
[[nodiscard]] HammersteinWienerFit FitHammersteinWiener(const Series& series,
                                                        const HammersteinWienerOptions& options);

/// What closes the loop of a free run: from the outputs of a sample to the inputs computed from
/// them.
using Feedback =
    std::function<void(Eigen::Index row, const Eigen::VectorXd& y, Eigen::VectorXd& u)>;

[[nodiscard]] Prediction PredictOneStep(const HammersteinWienerModel& model, const Series& series);
/// Rows from `from` on, each from outputs measured up to `steps` rows before it and inputs measured
/// up to itself; 1 is one step. Rows before `from` are measured ones. Cost: rows x steps.
[[nodiscard]] Prediction PredictAhead(const HammersteinWienerModel& model, const Series& series,
                                      Eigen::Index steps, Eigen::Index from);
/// The inputs are the series' own, or with `feedback` what it makes of the model's outputs; nothing
/// measured enters then.
[[nodiscard]] Prediction SimulateFreeRun(const HammersteinWienerModel& model, const Series& series,
                                         const Feedback& feedback = {});

}  // namespace levitas::identification
