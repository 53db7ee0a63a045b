#pragma once
// The finite elements know only the free rotor; the closed forms of textbooks hold for supported
// beams. Here a support removes unknowns from the assembled matrices.

#include <Eigen/Core>
#include <vector>

#include "plant_sim/rotor/finite_element.hpp"

namespace levitas::rotor {

/// The matrices of a model without the unknowns of its supports.
struct Supported {
  Eigen::MatrixXd mass;
  Eigen::MatrixXd gyroscopic;
  Eigen::MatrixXd stiffness;
};

/// `held` are indices of unknowns: 2 i is the deflection of node i, 2 i + 1 its slope.
[[nodiscard]] Supported Hold(const FiniteElementModel& model, const std::vector<int>& held);
[[nodiscard]] Supported PinnedAtBothEnds(const FiniteElementModel& model);
[[nodiscard]] Supported ClampedAtTheDriveEnd(const FiniteElementModel& model);

/// Every w [rad/s] of (-w^2 M + w W G + K) u = 0, ascending: backward whirl is negative.
[[nodiscard]] std::vector<double> Whirl(const Supported& shaft, double speed_rad_per_s);
/// The positive ones of Whirl, ascending.
[[nodiscard]] std::vector<double> Forward(const Supported& shaft, double speed_rad_per_s = 0.0);
/// Magnitudes of the negative ones of Whirl, ascending.
[[nodiscard]] std::vector<double> Backward(const Supported& shaft, double speed_rad_per_s);

}  // namespace levitas::rotor
