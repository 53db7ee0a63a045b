#pragma once
// What is known of a levitated rig's loop: its control law, its limit of current and the excitation
// that was added to the readings. It closes the loop of a model's free run.
//
// Equation  u = C(z) (0 - (y + excitation)), |u| <= limit: what controller/cycle commands while it
//           levitates.
// Use       AtRest() begins a run with the law's states zero and the excitation's first row; the
//           feedback refers to this object, which must outlive it.
// Thread    any number of runs beside one another.

#include <Eigen/Core>

#include "common/rig_numbers.hpp"
#include "controller/law/axis_law.hpp"
#include "identification/nonlinear/hammerstein_wiener.hpp"

namespace levitas::identification {

class KnownLoop {
 public:
  /// `excitation_m`: rows x axes, at the measured position.
  KnownLoop(const law::LawConfig& law, const RigNumbers& rig, Eigen::MatrixXd excitation_m);

  [[nodiscard]] Feedback AtRest() const;

 private:
  law::LawCoefficients coefficients_;
  double limit_a_;
  Eigen::MatrixXd excitation_m_;
};

}  // namespace levitas::identification
