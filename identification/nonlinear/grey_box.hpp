#pragma once
// A driven oscillator with a curved spring, from one input and one output: what an electronic
// Duffing circuit or one magnetic axis around its working point is.
//
// Equation  m y'' + d y' + k(y) = g u, sampled:
//             y_k = c + sum_i a_i y_{k-i} + sum_j b_j u_{k-j} + (powers 2 .. degree of y_{k-1}),
//           with `rate` all products of y_{k-1} and y_{k-2} of these degrees (a spring whose force
//           depends on the rate too, and what sampling makes of a curved one).
// Fit       least squares on one step, then the free run (refine.hpp).
// Reading   static spring u(y) and, of the linear part, natural frequency and damping ratio.
// Thread    any. Failure: BadInput by RefuseUnfit, or when no fit leads to a stable free run.

#include "identification/nonlinear/refine.hpp"

namespace levitas::identification {

struct OscillatorOptions {
  Eigen::Index order{2};  ///< of the linear part: 2, or 3 with a lag in the circuit
  int degree{3};          ///< of the spring; 1: linear
  bool rate{};
  RefineOptions refine{};
};

struct Oscillator {
  Refinement fit;
  double frequency_hz{};   ///< natural, of the slowest pair of the linear part; 0: none
  double damping_ratio{};  ///< of it
  /// Static spring: input that holds y, u = sum_n spring[n] y^n, in the units of the series.
  Eigen::VectorXd spring;
};

[[nodiscard]] Oscillator FitOscillator(const Series& series, const OscillatorOptions& options);

}  // namespace levitas::identification
