#pragma once
// Standard deviation of each parameter, and directions that the data do not identify.
//
// Equation  covariance C = max(1, chi^2) (J^T J + diag(1/prior^2))^-1 over the fitted unknowns, or,
//           where that is larger, C (S + diag(1/prior^2)) C with the scatter S of J^T r over groups
//           of neighbouring lines: misfit that is no noise widens the intervals (Huber 1967).
// Direction an eigenvector of the data's information in units of the priors whose eigenvalue is
//           below 1: along it the data say less than the prior. Mass, ki and ks together, and
//           sensor gain against ki, are such by nature: only products show in a response from
//           current to reading.
// Thread    any.

#include <string>
#include <vector>

#include "identification/modal/modal_fit.hpp"

namespace levitas::identification {

struct Unidentifiable {
  std::vector<std::string> unknowns;  ///< that move together, the largest share first
  std::string experiment;             ///< that would tell them apart
};

struct Uncertainty {
  Eigen::VectorXd deviation;  ///< one standard deviation per unknown; 0 when it was not fitted
  std::vector<Unidentifiable> directions;
  Eigen::VectorXd products;  ///< relative, of ki g/m per axis, then of ks/m: what responses tell
};

[[nodiscard]] Uncertainty Assess(const ModalStart& start, const ModalFit& fit);

}  // namespace levitas::identification
