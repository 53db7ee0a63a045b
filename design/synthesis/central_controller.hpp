#pragma once
// The steps of an H-infinity synthesis at one gamma: normal form, Riccati equations, controller.
//
// Source     K. Zhou, J. C. Doyle, K. Glover, Robust and Optimal Control, 1996, theorem 17.1 and
//            section 17.2 (scaling, loop shift). Symbols are the book's.
// Use        by hinf_synthesis.cpp, which searches gamma and checks the closed loop.
// Failure    a Verdict says which condition of the theorem fails. Thread: any; pure.

#include <Eigen/Core>

#include "design/synthesis/plant_rank.hpp"
#include "design/synthesis/state_space.hpp"

namespace levitas::synthesis {

/// The plant with D12 = [0; I], D21 = [0 I], D22 = 0, and the way back.
struct NormalPlant {
  Eigen::MatrixXd A, B1, B2, C1, C2, D11;
  Eigen::MatrixXd from_control;    ///< u = from_control u'
  Eigen::MatrixXd to_measurement;  ///< y' = to_measurement y
  Eigen::MatrixXd D22;
};

[[nodiscard]] NormalPlant Normalise(const GeneralisedPlant& plant);

/// No controller reaches below this: what of D11 the control and the measurement do not touch.
[[nodiscard]] double DirectLimit(const NormalPlant& plant);

/// One of the two Riccati equations and its gain. The filter's is the regulator's of the transposed
/// plant: A', [C1' C2'], [B1' ...].
struct Half {
  Eigen::MatrixXd solution;  ///< X (or Y)
  Eigen::MatrixXd gain;      ///< F (or L'): rows for w' (z'), then for u' (y')
};

struct Solved {
  Half regulator, filter;
};

enum class Verdict { kSolved, kDirect, kRegulator, kFilter, kCoupling };

/// For people: what limits gamma.
[[nodiscard]] const char* TextOf(Verdict verdict);

/// `out` is written when the Riccati equations have solutions.
[[nodiscard]] Verdict Solve(const NormalPlant& plant, double gamma, Solved& out);

/// The central controller; where D22 makes of it a loop of infinite gain, its neighbour with the
/// free parameter gamma/2, which meets the same bound.
[[nodiscard]] StateSpace Controller(const NormalPlant& plant, const Solved& solved, double gamma);

}  // namespace levitas::synthesis
