#pragma once
// The modal rig at one frequency: solved without magnets first, then with them. For the parts of
// the modal fit only.
//
// Equation  D_f q = Phi_a f without the magnets' stiffness, D = D_f - Phi_a K Phi_a^T with it. K
//           has the rank of the axes (Woodbury): X = D^-1 Phi_a = X_f (I - K M)^-1 with X_f =
//           D_f^-1 Phi_a, M = Phi_a^T X_f; Z = D^-T Phi_s = Z_f + Y_f (I - K M^T)^-1 K Phi_a^T Z_f
//           with Y_f = D_f^-T Phi_a. So other magnets cost little.
// Units     SI; matrices have 2 modes rows (plane x, then y) and a column per axis.
// Thread    any; no shared state.

#include <Eigen/Core>
#include <complex>

#include "identification/modal/modal_parameters.hpp"

namespace levitas::identification {

using ComplexRows =
    Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct ModalLine {
  const ModalFrame& frame;
  const Physical& rig;
  double frequency_hz;
  double speed_rad_per_s;
  std::complex<double> s;
  Eigen::VectorXcd left, right;  ///< per axis: g hs and ki ha
  Eigen::MatrixXcd actuator, sensor;
  Eigen::MatrixXcd free_x, free_y, free_z;  ///< without magnets
  Eigen::MatrixXcd at_magnets;              ///< M
  Eigen::MatrixXcd beyond;  ///< reading per force of the modes beyond the fitted ones

  [[nodiscard]] Eigen::Index modes() const { return frame.layout.modes(); }
  [[nodiscard]] Eigen::Index axes() const { return frame.layout.axes(); }
};

/// With `derive` also what only derivatives need.
[[nodiscard]] ModalLine SolveFree(const ModalFrame& frame, const Physical& rig, double frequency_hz,
                                  double speed_rad_per_s, bool derive);

/// The line with magnets of stiffness `ks` [N/m] per axis.
struct ClosedLine {
  Eigen::MatrixXcd x, z;     ///< z only with `derive`
  Eigen::MatrixXcd reading;  ///< per force: axes x axes, sensor chain included
};
[[nodiscard]] ClosedLine AddMagnets(const ModalLine& line, const Eigen::VectorXd& ks, bool derive);

}  // namespace levitas::identification
