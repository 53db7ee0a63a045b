#pragma once
// Small linear models for the tests of the synthesis: drawn ones, and those with closed forms.

#include <string>

#include "common/random.hpp"
#include "design/synthesis/plant_rank.hpp"
#include "design/synthesis/state_space.hpp"

namespace levitas::synthesis {

[[nodiscard]] Eigen::MatrixXd DrawMatrix(Random& random, Eigen::Index rows, Eigen::Index columns);
/// Poles' real parts at most -0.1.
[[nodiscard]] StateSpace DrawStable(Random& random, Eigen::Index states, Eigen::Index inputs,
                                    Eigen::Index outputs);
/// Stable or not, D11 and D22 full.
[[nodiscard]] GeneralisedPlant DrawPlant(Random& random, Eigen::Index states);

/// gain (s/zero + 1)/(s/pole + 1)
[[nodiscard]] StateSpace FirstOrder(double gain, double zero, double pole);

/// The message with which a synthesis refuses the plant; empty when it finds a controller.
[[nodiscard]] std::string RefusalOf(const GeneralisedPlant& plant);

/// dx = a x + w1 + u, z = (x, u), y = x + w2: smallest gamma a + sqrt(a^2 + 2), where both Riccati
/// equations have the same solution X and X = gamma.
[[nodiscard]] GeneralisedPlant ScalarPlant(double a);

/// z = W (w + P u), y = w + P u.
[[nodiscard]] GeneralisedPlant SensitivityPlant(const StateSpace& plant, const StateSpace& weight);

/// A mass on a magnet (unstable at 33 Hz) with lightly damped modes at 90, 252, 510 and 730 Hz
/// (damping ratio 0.003), amplifier of 720 Hz and a second-order Pade delay of 0.15 ms: the shape
/// of one axis of a flexible rotor, position in units of 36 um, current in A; z = (current,
/// position), w = (disturbance current, noise).
[[nodiscard]] GeneralisedPlant FlexibleAxis();

}  // namespace levitas::synthesis
