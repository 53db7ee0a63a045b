#pragma once
// Correction weights for the accessible planes of a rotor, and what they leave.
//
// Equation   W = argmin sum_k |y_k + T_k E W|^2 + q |W|^2: y_k the synchronous response of the
//            shaft as it is, T_k what unbalance adds to it (forecast.hpp, influence.hpp), E the
//            accessible ones among the planes. q keeps a plane that moves nothing from a weight
//            that does nothing: 1e-6 of the plane's own column.
// Sign       W [kg m] is added unbalance: a mass W/radius at the angle of W, or the same mass taken
//            away on the other side.
// Interval   of W, from the covariance of the unbalance through the same linear map.
// Thread     any; pure.

#include <Eigen/Core>
#include <vector>

#include "identification/balance/forecast.hpp"

namespace levitas::balancing {

struct Correction {
  Eigen::VectorXcd added_kg_m;  ///< per accessible plane
  Eigen::MatrixXd covariance;   ///< of its (real parts, imaginary parts)
};

/// `accessible`: which of the rig's planes. `covariance` of (real, imaginary parts) of its planes.
[[nodiscard]] Correction Correct(const std::vector<SpeedResponse>& responses,
                                 const std::vector<Eigen::Index>& accessible,
                                 const Eigen::MatrixXd& covariance);

/// Orbits over speed, per bearing [m], of the shaft (run-out is not in them).
struct OrbitForecast {
  double speed_rad_per_s{};
  Eigen::VectorXd before_m, after_m;
  Eigen::VectorXd after_high_m;  ///< 95 % of what the covariance allows lies below
};

/// `added_kg_m`: per plane of the rig.
[[nodiscard]] std::vector<OrbitForecast> ForecastOrbits(const std::vector<SpeedResponse>& responses,
                                                        const Eigen::VectorXcd& added_kg_m,
                                                        const Eigen::MatrixXd& covariance);

}  // namespace levitas::balancing
