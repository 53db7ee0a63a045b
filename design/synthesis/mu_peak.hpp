#pragma once
// The largest structured singular value of a stable model over all frequencies, between grid points
// too.
//
// Equation   sup over w of mu(M(jw)), M(s) = C (sI - A)^-1 B + D
// Method     scalings D, G found at one frequency prove mu <= level as long as
//            M* D M + j (G M - M* G) - level^2 D stays negative definite with them held constant;
//            the neighbouring frequencies at which it stops are imaginary eigenvalues of a
//            Hamiltonian (hamiltonian.hpp). Intervals proven in this way are laid side by side from
//            zero to infinity; a frequency above the level raises the level.
// Result     `upper` holds at every frequency; `lower` is reached by a perturbation at `rad_per_s`.
// Units      [rad/s]. Thread: any; pure.
// Failure    Problem when the model is unstable, or when the proof needs too many intervals.

#include <vector>

#include "design/synthesis/state_space.hpp"
#include "design/synthesis/structured_singular_value.hpp"

namespace levitas::synthesis {

struct MuPoint {
  double rad_per_s{};
  double upper{};
};

struct MuPeak {
  double upper{};             ///< no frequency exceeds it
  double at_peak{};           ///< upper bound at `rad_per_s` alone: the largest one evaluated
  double lower{};             ///< lower bound at `rad_per_s`
  double rad_per_s{};         ///< where the largest upper bound was found
  std::vector<MuPoint> grid;  ///< every frequency evaluated, ascending
  std::size_t intervals{};    ///< that the proof took
};

struct MuPeakOptions {
  double tolerance{0.01};  ///< `upper` exceeds `at_peak` by this share
  double first_rad_per_s{0.1};
  double last_rad_per_s{1e5};
  int points{60};  ///< of the first search, logarithmic; resonances are added
  std::size_t most_intervals{400};
};

[[nodiscard]] MuPeak PeakOfMu(const StateSpace& system, const UncertaintyBlocks& blocks,
                              const MuPeakOptions& options = {});

}  // namespace levitas::synthesis
