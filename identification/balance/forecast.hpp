#pragma once
// The synchronous response of the levitated rotor over speed: what unbalance leaves with a law.
//
// Equation   y = (1 + P C)^-1 (H w^2 U + R),  P = C0 (jw - A)^-1 B d(jw), the rig as fitted.
// Law        of the session's controller, at e^{jwT}; where none is known, what the record shows:
//            i = -c y axis by axis, between the windows by a straight line. A law that follows the
//            rotation (a synchronous controller) is then in c.
// Radius     largest distance from the centre of the ellipse that x and y of a bearing make.
// Units      SI; complex as balance_rig.hpp says. Thread: any; allocates.
// Failure    BadInput when the controller has other axes than the rig.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "analysis/records/order_track.hpp"
#include "controller/law/law_config.hpp"
#include "identification/balance/balance_rig.hpp"

namespace levitas::balancing {

/// C [A/m] at a speed: i = -C y.
using LawOverSpeed = std::function<Eigen::MatrixXcd(double speed_rad_per_s)>;

[[nodiscard]] LawOverSpeed FromController(const law::LawConfig& law, double period_s);
[[nodiscard]] LawOverSpeed FromRecord(std::vector<analysis::TrackedWindow> windows);

struct SpeedResponse {
  double speed_rad_per_s{};
  Eigen::MatrixXcd per_unbalance;  ///< axes x planes [m per kg m]
  Eigen::MatrixXcd per_runout;     ///< axes x axes: the sensitivity
  Eigen::VectorXcd now_m;          ///< of the shaft as it is, run-out taken off; set by the caller
};

[[nodiscard]] std::vector<SpeedResponse> ResponsesOverSpeed(
    const BalanceRig& rig, const Eigen::VectorXd& place, const LawOverSpeed& law,
    const std::vector<double>& speeds_rad_per_s);

/// Of x and y, axis by axis, per bearing.
[[nodiscard]] Eigen::VectorXd Radii(const Eigen::VectorXcd& position);

}  // namespace levitas::balancing
