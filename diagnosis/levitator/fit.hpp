#pragma once
// Tolerances and a given set of causes fitted together, and what the data say for the set.
//
// Method     Levenberg-Marquardt from a start on the whitened errors plus the parameters over their
//            priors; a value that would have to be impossible (Row::least) stays at its bound.
// Evidence   Laplace's approximation, -1/2 (squared sum + penalty + log det): differences between
//            sets on the same whitening mean something, one number alone does not. As in
//            diagnosis/inference/evidence.hpp, where a prior of its own is added for every place.
// Units      nat. Thread: blocks the caller, every processor inside.

#include <vector>

#include "diagnosis/levitator/causes.hpp"
#include "diagnosis/levitator/misfit.hpp"

namespace levitas::levitator {

using Causes = std::vector<diagnosis::Hypothesis>;

struct Fitted {
  Theta theta;
  Theta deviation;             ///< posterior, zero for what was not fitted
  Eigen::MatrixXd covariance;  ///< posterior of the common values
  double evidence{};
  double squared_sum{};
};

/// A healthy rig's parameter may lie within so many of its tolerances: with 1e5 nat at stake the
/// prior alone would let calibration take what no healthy rig has.
inline constexpr double kFarthest = 2.0;

/// Everything that a set leaves free, its prior and its bounds.
struct Freedom {
  std::vector<std::size_t> active;
  Eigen::VectorXd deviation;
  /// Of the prior, in units of its deviations: the identity where values are independent.
  Eigen::MatrixXd precision;
  Eigen::VectorXd least, most;
  double log_prior{};  ///< of the places
  std::size_t one_sided{};
};

/// `known`: NominalRig::known, which takes the place of the table's tolerances.
[[nodiscard]] Freedom FreedomOf(const Causes& causes, std::size_t records,
                                const Theta& origin = Zeros(0), const Eigen::MatrixXd& known = {});

class Fitter {
 public:
  explicit Fitter(const Misfit& misfit) : misfit_(misfit) {}

  [[nodiscard]] Fitted Fit(const Causes& causes, const Theta& start, const Filters& filters,
                           int steps) const;
  /// What each cause would add to the set by one linearisation at its fit [nat]; minus infinity for
  /// what would have to be impossible.
  [[nodiscard]] std::vector<double> Screen(const Causes& causes, const Fitted& at,
                                           const Filters& filters) const;

  /// Everything free at once: what no parameter explains is taken for noise, and whitened.
  [[nodiscard]] Filters Noise() const;

  [[nodiscard]] const Misfit& misfit() const { return misfit_; }

 private:
  const Misfit& misfit_;
};

}  // namespace levitas::levitator
