#pragma once
// The unbalance of a rotor from the order-tracked run-up, together with what the rig file does not
// know exactly.
//
// Cost       sum |r|^2 of predictor.hpp in unit variances, + (place/deviation)^2 of each unknown of
//            the rig, + |R|^2 / tolerance of the run-out, + |U|^2 / size^2 of each plane. The size
//            is that of the record's own unbalance: size^2 = mean(|U|^2 + variance), so that what
//            the speeds do not show stays small instead of becoming noise.
// Method     U and R solved exactly for every trial of the rig (Golub & Pereyra, SIAM J. Numer.
//            Anal. 10, 1973), the rig's unknowns by Levenberg-Marquardt with Kaufman's slopes;
//            round by round until the place that the predictor refers to is the one found.
// Intervals  of the normal equations at the minimum, times the reduced chi-square where that is
//            above 1, times 4/3 for windows that overlap by half (their noise is correlated by
//            1/6).
// Units      kg m, m; complex as balance_rig.hpp says. Thread: any; allocates.
// Bounds     no unknown is sought beyond eight of its deviations.
// Failure    none; `converged` says whether the search ended at a minimum.

#include <Eigen/Core>

#include "identification/balance/predictor.hpp"

namespace levitas::balancing {

struct UnbalanceFit {
  Eigen::VectorXcd unbalance_kg_m;  ///< per plane of the rig
  Eigen::VectorXcd runout_m;        ///< per axis
  Eigen::VectorXd place;            ///< of the rig's unknowns
  Eigen::VectorXd place_deviation;
  /// Of (real parts, imaginary parts) of the unbalance, the rig's unknowns included.
  Eigen::MatrixXd covariance;
  Eigen::VectorXd runout_deviation_m;
  double size_kg_m{};
  double reduced_chi_square{};
  std::size_t windows{};
  bool converged{};
};

[[nodiscard]] UnbalanceFit FitUnbalance(Predictor& predictor);

}  // namespace levitas::balancing
