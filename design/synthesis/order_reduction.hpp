#pragma once
// Controllers of fewer states: balanced truncation of the stable part.
//
// Equation   A P + P A' + B B' = 0, A' Q + Q A + C' C = 0; Hankel singular values sqrt(eig(P Q));
//            the stable part of order r is within 2 sum_{i > r} of the whole at every frequency.
// Method     square-root balancing: K. Glover, Int. J. Control 39 (1984) 1115; M. S. Tombs,
//            I. Postlethwaite, Int. J. Control 46 (1987) 1319. Poles that do not decay are split
//            off by the matrix sign and kept as they are, states that balance nothing are dropped.
// Note       the bound is of the controller alone. Whether the loop keeps its stability and its mu
//            is for the caller's criterion, which ReduceKeeping evaluates for each order it tries.
// Failure    Problem when an equation has no solution, or when not even the full order is allowed.
// Thread     any; pure.

#include <Eigen/Core>
#include <functional>

#include "design/synthesis/state_space.hpp"

namespace levitas::synthesis {

struct SplitSystem {
  StateSpace stable;  ///< holds D
  StateSpace other;   ///< poles on or right of the imaginary axis; D = 0
};

/// `system` as the sum of two.
[[nodiscard]] SplitSystem SplitStable(const StateSpace& system);

struct BalancedSystem {
  StateSpace stable;  ///< balanced, largest Hankel singular value first
  Eigen::VectorXd hankel_values;
  StateSpace other;
  [[nodiscard]] Eigen::Index states() const noexcept { return stable.states() + other.states(); }
  [[nodiscard]] Eigen::Index fewest() const noexcept { return other.states(); }
  /// The first states of the stable part and all of the other: `states` in all.
  [[nodiscard]] StateSpace Truncated(Eigen::Index states) const;
};

[[nodiscard]] BalancedSystem Balance(const StateSpace& system);

struct ReducedController {
  StateSpace controller;
  double criterion{};  ///< of the reduced controller
};

/// The lowest order whose criterion is at most `allowed`: bisection, so that about log2(states)
/// orders are evaluated. The criterion (mu of the closed loop, infinite when it is unstable) should
/// rise as states go; the result meets it in any case.
[[nodiscard]] ReducedController ReduceKeeping(
    const StateSpace& controller, const std::function<double(const StateSpace&)>& criterion,
    double allowed);

}  // namespace levitas::synthesis
