#pragma once
// The H-infinity norm of a stable model: the largest singular value over all frequencies.
//
// Equation   max over w of sigma_max(G(jw)), G(s) = C (sI - A)^-1 B + D
// Method     two-step: a level above the best value found so far is tested by the imaginary
//            eigenvalues of its Hamiltonian; the midpoints between crossings give the next value
//            (N. A. Bruinsma, M. Steinbuch, Systems & Control Letters 14 (1990) 287). The result
//            brackets the norm between frequencies too.
// Independent of the synthesis: shares no Riccati solver with it.
// Failure    Problem when the model is unstable.
// Thread     any; pure.

#include "design/synthesis/state_space.hpp"

namespace levitas::synthesis {

struct HinfNorm {
  double lower{};      ///< attained at `rad_per_s`
  double upper{};      ///< no frequency exceeds it
  double rad_per_s{};  ///< infinite when the direct gain is the largest
};

/// `upper` exceeds `lower` by at most the relative tolerance.
[[nodiscard]] HinfNorm NormOf(const StateSpace& system, double tolerance = 1e-4);

}  // namespace levitas::synthesis
