#pragma once
// NARX and NARMAX models of a series: terms chosen by FROLS, coefficients by (extended) least
// squares on one-step-ahead predictions.
//
// NARX     polynomial terms up to a degree, or a network of tanh units with random directions of
//          which FROLS keeps the useful ones (an equivalent of a trained sigmoid network that has
//          one optimum and needs no second seed).
// NARMAX   polynomial process terms by FROLS; then the errors' lags join as linear terms and all
//          coefficients are estimated again with the errors of the pass before, up to `passes`
//          times (extended least squares: Billings 2013, ch. 3.6).
// Fitting  is one step ahead, so a model may predict well and run free badly, or diverge: judge it
//          by SimulateFreeRun.
// Thread   any. Failure: BadInput by RefuseUnfit.

#include <cstdint>

#include "identification/nonlinear/frols.hpp"
#include "identification/nonlinear/lagged_model.hpp"

namespace levitas::identification {

struct NarxOptions {
  WindowLayout layout;         ///< error_lags > 0: NARMAX
  int degree{3};               ///< of polynomial terms
  std::size_t most_terms{14};  ///< per output, error terms not counted
  double least_ratio{1e-12};
  std::size_t network_units{};  ///< > 0: a network; linear terms are all kept
  std::uint64_t seed{1};        ///< of the network's directions
  std::size_t most_rows{8000};  ///< that the choice of terms looks at, evenly spread
  int passes{10};               ///< of extended least squares
};

struct NarxFit {
  LaggedModel model;
  std::vector<std::vector<double>> ratio;  ///< ERR per output and term
};

/// All products of up to `degree` entries of the window without the error lags, constant first.
[[nodiscard]] std::vector<Feature> PolynomialTerms(const WindowLayout& layout, int degree);

[[nodiscard]] NarxFit FitNarx(const Series& series, const NarxOptions& options);

}  // namespace levitas::identification
