#pragma once
// The transfer function of an existing controller from what it was given and what it made of it,
// and that as a part of a law that `amb run` takes.
//
// Data      one input and one output, sampled together, in open or closed loop: the input is what
//           the controller saw, so feedback around it changes nothing. A chirp over the band is
//           best (H.-L. Chiu 2022, Appl. Sci. 12, 8556: 0 to 5000 Hz logarithmically in 10 s).
// Fit       rational_fit.hpp, on all lines of the band: every 1/duration; noise of the output is
//           taken as white.
// Order     the least of Schwarz's criterion, 2K ln(squares/2K) + unknowns ln(2K) over K lines;
//           what is left below 1e-9 of the output is rounding.
// Not done  one output of several inputs; a limit that was reached; gains that change meanwhile.
// Units     of the columns. Thread: any. Failure: BadInput in a sentence.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "controller/law/law_config.hpp"
#include "identification/law/rational_fit.hpp"

namespace levitas::identification {

/// What a controller was given and what it made of it, row by row.
struct LawSignals {
  std::string name;
  Eigen::VectorXd input, output;
};

struct LawFitOptions {
  LawDomain domain{LawDomain::kContinuous};
  double period_s{};
  double lowest_hz{};   ///< 0: twice the line spacing
  double highest_hz{};  ///< 0: 0.4 of the sampling rate, of a discrete law 0.5
  std::size_t most_order{12};
  std::optional<std::size_t> order{};  ///< this one instead of a choice
};

struct OrderTried {
  std::size_t order{};
  double fit_percent{};  ///< 100 (1 - |Y - fit|/|Y|)
  double criterion{};
};

struct LawFit {
  std::string name;
  LawFitOptions options;  ///< with the band that was used
  RationalFit law;
  std::size_t lines{};
  double fit_percent{};
  std::vector<OrderTried> tried;
  /// Output over input, averaged over bands of a fiftieth of an octave, for pictures.
  std::vector<double> measured_hz;
  std::vector<std::complex<double>> measured;

  [[nodiscard]] std::complex<double> At(double frequency_hz) const;
};

[[nodiscard]] LawFit FitLaw(const LawSignals& signals, const LawFitOptions& options);

/// Adds blocks and direct gain of `fit` to the law, from and to `axis`. The law is in the domain of
/// the fit, its gains per axis are set; `output_per_input` is what a unit of the fit is in units of
/// the law's signals.
void AddToLaw(const LawFit& fit, std::size_t axis, double output_per_input,
              law::StateSpaceConfig& law);

}  // namespace levitas::identification
