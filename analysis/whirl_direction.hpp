#pragma once
// Direction of a rotor's mode: forward (with the rotation), backward, or along a line.
//
// Equation  r = x + j y of complex modal displacements x, y: (x + j y) is the part that whirls
//           forward, (x - j y) the part that whirls backward.
// Thread    any; pure. Failure: none; a vector of zeros counts as a line.

#include <Eigen/Core>
#include <complex>

namespace levitas::analysis {

/// 0 backward .. 0.5 a line .. 1 forward. `vector` starts with the rotor's modal displacements of
/// plane x and then of plane y, `modes` each.
[[nodiscard]] inline double ForwardShare(const Eigen::VectorXcd& vector, Eigen::Index modes) {
  const std::complex<double> j{0.0, 1.0};
  const auto x = vector.head(modes);
  const auto y = vector.segment(modes, modes);
  const double forward = (x + j * y).squaredNorm();
  const double backward = (x - j * y).squaredNorm();
  return forward + backward > 0.0 ? forward / (forward + backward) : 0.5;
}

}  // namespace levitas::analysis
