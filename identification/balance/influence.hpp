#pragma once
// Influence coefficients of the planes over speed, put right by what a weight was seen to do.
//
// Measured   dy = y2 - y1 between two run-ups, W what was put on the rotor between them.
// Equation   T' = T + (dy - T W) W^H / |W|^2: the least change of the model's coefficients that
//            explains what was measured (C. G. Broyden, Math. Comp. 19, 1965). With it the response
//            left is what the second run shows, y2 less run-out, whatever the model has wrong; the
//            next correction starts from there.
// Speeds     that both runs pass; between windows by a straight line. Others keep the model's.
// Units      SI. Thread: any; pure.

#include <Eigen/Core>
#include <vector>

#include "analysis/records/order_track.hpp"
#include "identification/balance/forecast.hpp"

namespace levitas::balancing {

/// Positions over speed as a run shows them.
class MeasuredResponse {
 public:
  explicit MeasuredResponse(std::vector<analysis::TrackedWindow> windows);
  [[nodiscard]] bool Covers(double speed_rad_per_s) const;
  /// Between the windows on either side; of a speed that is covered.
  [[nodiscard]] Eigen::VectorXcd At(double speed_rad_per_s) const;

 private:
  std::vector<analysis::TrackedWindow> windows_;  ///< ascending in speed
};

struct InfluenceChange {
  double speed_rad_per_s{};
  Eigen::VectorXcd measured_m;  ///< dy, per axis
  Eigen::VectorXcd model_m;     ///< T W
};

/// Changes `responses`: coefficients, and `now_m` from the second run.
std::vector<InfluenceChange> UpdateInfluence(const MeasuredResponse& before,
                                             const MeasuredResponse& now,
                                             const Eigen::VectorXcd& added_kg_m,
                                             const Eigen::VectorXcd& runout_m,
                                             std::vector<SpeedResponse>& responses);

}  // namespace levitas::balancing
