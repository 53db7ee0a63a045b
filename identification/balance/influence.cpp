#include "identification/balance/influence.hpp"

#include <algorithm>

namespace levitas::balancing {

using analysis::TrackedWindow;

MeasuredResponse::MeasuredResponse(std::vector<TrackedWindow> windows)
    : windows_(std::move(windows)) {
  std::ranges::sort(windows_, {}, &TrackedWindow::speed_rad_per_s);
}

bool MeasuredResponse::Covers(double speed_rad_per_s) const {
  return !windows_.empty() && speed_rad_per_s >= windows_.front().speed_rad_per_s &&
         speed_rad_per_s <= windows_.back().speed_rad_per_s;
}

Eigen::VectorXcd MeasuredResponse::At(double speed_rad_per_s) const {
  const auto above =
      std::ranges::lower_bound(windows_, speed_rad_per_s, {}, &TrackedWindow::speed_rad_per_s);
  if (above == windows_.begin()) return above->position_m;
  if (above == windows_.end()) return windows_.back().position_m;
  const auto below = above - 1;
  const double span = above->speed_rad_per_s - below->speed_rad_per_s;
  const double share = span > 0.0 ? (speed_rad_per_s - below->speed_rad_per_s) / span : 0.0;
  return (1.0 - share) * below->position_m + share * above->position_m;
}

std::vector<InfluenceChange> UpdateInfluence(const MeasuredResponse& before,
                                             const MeasuredResponse& now,
                                             const Eigen::VectorXcd& added_kg_m,
                                             const Eigen::VectorXcd& runout_m,
                                             std::vector<SpeedResponse>& responses) {
  std::vector<InfluenceChange> changes;
  const double square = added_kg_m.squaredNorm();
  for (SpeedResponse& at : responses) {
    const double speed = at.speed_rad_per_s;
    if (square == 0.0 || !before.Covers(speed) || !now.Covers(speed)) continue;
    const Eigen::VectorXcd reading = now.At(speed);
    InfluenceChange change{speed, reading - before.At(speed), at.per_unbalance * added_kg_m};
    at.per_unbalance += (change.measured_m - change.model_m) * added_kg_m.adjoint() / square;
    at.now_m = reading - at.per_runout * runout_m;
    changes.push_back(std::move(change));
  }
  return changes;
}

}  // namespace levitas::balancing
