#pragma once
// What is known of a levitated rig's loop: its control law, its limit of current and what was added
// to readings and commands. It closes the loop of a model's free run.
//
// Equation  u = C(z) (0 - (y + e_position)) + e_current, |u| <= limit: what controller/cycle
//           commands while it levitates.
// Use       AtRest() begins a run with the law's states zero and the excitation's first row; the
//           feedback refers to this object, which must outlive it.
// Thread    any number of runs in parallel.

#include <Eigen/Core>

#include "common/rig_numbers.hpp"
#include "controller/law/axis_law.hpp"
#include "identification/nonlinear/hammerstein_wiener.hpp"

namespace levitas::identification {

/// Rows x axes; a matrix without rows is an excitation that is not there.
struct LoopExcitation {
  Eigen::MatrixXd position_m;  ///< added to the readings
  Eigen::MatrixXd current_a;   ///< added to the commands
};

class KnownLoop {
 public:
  KnownLoop(const law::LawConfig& law, const RigNumbers& rig, LoopExcitation excitation);

  [[nodiscard]] Feedback AtRest() const;

 private:
  law::LawCoefficients coefficients_;
  double limit_a_;
  LoopExcitation excitation_;
};

}  // namespace levitas::identification
