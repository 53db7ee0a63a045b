#pragma once
// D-K iteration: a controller that makes the structured singular value of its loop small.
//
// Equation   min over K and D(jw) of max over w of sigma_max(D F_l(P, K) D^-1), in turns: K by
//            H-infinity synthesis with D held, D by the upper bound of mu at each frequency with K
//            held, its magnitudes fitted by stable minimum-phase systems that join the plant.
// Source     G. Balas, J. C. Doyle, K. Glover, A. Packard, R. Smith, mu-Analysis and Synthesis
//            Toolbox, 1991, chapter 5. The turns are not convex together: the result depends on the
//            start.
// Blocks     take the plant's disturbances and errors from first to last; the last is usually the
//            performance block (full complex). While iterating, a repeated block counts as that
//            many scalars of their own and a real one as complex (larger sets); the controller kept
//            is the best by the given blocks, and its peak is proven between frequencies.
// Result     the controller with the smallest mu of all turns, of the order of plant and scalings.
// Failure    Problem of the first synthesis. A later turn that fails ends the iteration.
// Thread     any; pure.

#include <vector>

#include "design/synthesis/hinf_synthesis.hpp"
#include "design/synthesis/mu_peak.hpp"

namespace levitas::synthesis {

struct DkOptions {
  int turns{4};
  int largest_order{4};    ///< of each scaling
  double fit_error{0.05};  ///< ln; a scaling is raised in order until it is this close
  double settled{0.01};    ///< ends when mu falls by less than this share
  MuPeakOptions peak;      ///< frequency range and grid, tolerance of the proof
  HinfOptions hinf{.tolerance = 3e-3, .relaxation = 1.02};
};

struct DkTurn {
  double gamma{};  ///< of the scaled plant
  double mu{};     ///< proven peak of the loop, given blocks
  Eigen::Index states{};
};

struct DkResult {
  StateSpace controller;
  MuPeak peak;  ///< of F_l(P, K) with the given blocks
  std::vector<DkTurn> turns;
};

[[nodiscard]] DkResult IterateDk(const GeneralisedPlant& plant, const UncertaintyBlocks& blocks,
                                 const DkOptions& options = {});

}  // namespace levitas::synthesis
