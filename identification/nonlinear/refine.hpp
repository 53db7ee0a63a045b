#pragma once
// Coefficients of a lagged model that minimise its free-run error, from the one-step estimate.
//
// Equation  minimises sum_k |y_k - yhat_k(theta)|^2 over the free run by Levenberg-Marquardt; the
//           exact sensitivities follow the model's own recursion,
//           s_k = f(w_k) + sum_lags (d yhat / d w_lag) s_{k - lag} (Ljung 1999, ch. 10.3).
// Start     a model whose free run is stable; a trial that diverges is rejected like one that fits
//           worse.
// Thread    any. Failure: none thrown; `converged` says.

#include "identification/nonlinear/lagged_model.hpp"

namespace levitas::identification {

struct RefineOptions {
  int most_iterations{30};
  double least_gain{1e-7};  ///< relative, of the sum of squares: stops below
  Eigen::Index skip{50};    ///< rows that judge nothing: the start's transient
};

struct Refinement {
  LaggedModel model;
  double rms_before{}, rms_after{};  ///< over all outputs, in scales
  Eigen::VectorXd deviation;  ///< one standard deviation per coefficient, residual taken as white
  int iterations{};
  bool converged{};
};

[[nodiscard]] Refinement RefineFreeRun(const LaggedModel& start, const Series& series,
                                       const RefineOptions& options = {});

}  // namespace levitas::identification
