#pragma once
// A stable minimum-phase model whose gain follows given magnitudes: how scalings D become systems.
//
// Phase      from the magnitudes by Bode's relation for minimum phase,
//            arg(w0) = 1/pi int d ln|H|/du ln coth(|u|/2) du, u = ln(w/w0); ln|H| linear in between
//            and level outside (H. W. Bode, Network Analysis and Feedback Amplifier Design, 1945).
// Fit        ratio of two sums of partial fractions with fixed real poles, by iterated linear least
//            squares (C. K. Sanathanan, J. Koerner, IEEE Trans. Automatic Control 8 (1963) 56);
//            poles and zeros on the right are mirrored, which changes no magnitude.
// Units      [rad/s], magnitudes > 0 of any unit. Thread: any; pure.
// Failure    std::invalid_argument for fewer than three points, or magnitudes that are not
//            positive.

#include <Eigen/Core>

#include "design/synthesis/state_space.hpp"

namespace levitas::synthesis {

struct MagnitudeFit {
  StateSpace system;   ///< one input, one output; its inverse is stable too
  double log_error{};  ///< largest weighted |ln(model/given)|
};

/// Of one order. `weights` (0 to 1) say where the fit matters; frequencies ascend.
[[nodiscard]] MagnitudeFit FitMagnitude(const Eigen::VectorXd& rad_per_s,
                                        const Eigen::VectorXd& magnitudes,
                                        const Eigen::VectorXd& weights, int order);

/// The lowest order up to `largest_order` with an error of at most `allowed`, else the best.
[[nodiscard]] MagnitudeFit FitMagnitudeUpTo(const Eigen::VectorXd& rad_per_s,
                                            const Eigen::VectorXd& magnitudes,
                                            const Eigen::VectorXd& weights, int largest_order,
                                            double allowed);

/// 1/system of a model with a direct gain.
[[nodiscard]] StateSpace Inverse(const StateSpace& system);

}  // namespace levitas::synthesis
