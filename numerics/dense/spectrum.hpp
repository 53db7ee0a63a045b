#pragma once
// Eigenvalues and eigenvectors of a real matrix, never those of an iteration that did not end.
//
// Why      the shifted QR algorithm of Eigen::EigenSolver now and then walks in a circle: of closed
//          loops of one rotor at 257 speeds it gave up on two. Its eigenvalues are then what stood
//          in memory before: a stable loop or an unstable one, as chance has it.
// Method   EigenSolver; where it gives up, the same of H A H, H = I - 2 v v' a reflection, which
//          has the same eigenvalues and takes another way, up to eight times.
// Numbers  that are none in A: all eigenvalues are none either.
// Failure  std::runtime_error when no way ends.
// Thread   any; pure: the same matrix, the same bits.

#include <Eigen/Core>

namespace levitas::numerics {

struct Spectrum {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  ///< column i to values[i], of length 1; empty when not asked for
};

[[nodiscard]] Spectrum SpectrumOf(const Eigen::MatrixXd& a);
[[nodiscard]] Eigen::VectorXcd EigenvaluesOf(const Eigen::MatrixXd& a);

}  // namespace levitas::numerics
