#include "analysis/records/order_track.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "analysis/turn_windows.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::analysis {
namespace {

using Eigen::Index;

/// A mean and two orders, cosine and sine each.
constexpr Index kUnknowns = 5;
/// Of the current limit: a command beyond it is not what flows; one at it is.
constexpr double kWithinLimit = 1.001;

/// As turn_windows.hpp wants it.
struct UsableRows {
  const std::vector<std::uint64_t>& cycle;
  std::vector<std::uint8_t> levitated;
  const session::Column& speed_rad_per_s;
  const session::Column& angle_rad;
};

bool Usable(const session::Recording& r, std::size_t row) {
  if (r.levitated[row] == 0 || !std::isfinite(r.speed_rad_per_s[row]) ||
      !std::isfinite(r.angle_rad[row])) {
    return false;
  }
  for (std::size_t axis = 0; axis < r.axes(); ++axis) {
    // Not >=: what is no number is not within.
    if (!(std::abs(r.position_m[axis][row]) < r.sensor_range_m[axis])) return false;
    if (!(std::abs(r.current_a[axis][row]) < kWithinLimit * r.current_limit_a)) return false;
  }
  return true;
}

/// Normal equations of the weighted fit, one row at a time.
struct WindowFit {
  explicit WindowFit(Index signals)
      : normal(Eigen::MatrixXd::Zero(kUnknowns, kUnknowns)),
        right(Eigen::MatrixXd::Zero(kUnknowns, signals)),
        values(signals) {}

  void Add(double weight, double angle_rad) {
    Eigen::Matrix<double, kUnknowns, 1> basis;
    basis << 1.0, std::cos(angle_rad), std::sin(angle_rad), std::cos(2.0 * angle_rad),
        std::sin(2.0 * angle_rad);
    normal.noalias() += weight * basis * basis.transpose();
    right.noalias() += weight * basis * values;
    sum += weight;
    squares += weight * weight;
  }

  Eigen::MatrixXd normal, right;
  Eigen::RowVectorXd values;  ///< of the row to be added: positions, then currents
  double sum{}, squares{};
};

TrackedWindow FitWindow(const session::Recording& r, const TurnWindow& window) {
  const auto axes = static_cast<Index>(r.axes());
  WindowFit fit(2 * axes);
  const auto rows = static_cast<double>(window.last - window.first + 1);
  TrackedWindow made;
  double speed = 0.0;
  double slope = 0.0;
  double spread = 0.0;
  for (std::size_t row = window.first; row <= window.last; ++row) {
    const double place = (static_cast<double>(row - window.first) + 0.5) / rows - 0.5;
    const double weight = 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * place);
    for (Index axis = 0; axis < axes; ++axis) {
      fit.values[axis] = r.position_m[static_cast<std::size_t>(axis)][row];
      fit.values[axes + axis] = r.current_a[static_cast<std::size_t>(axis)][row];
    }
    fit.Add(weight, r.angle_rad[row]);
    speed += weight * r.speed_rad_per_s[row];
    slope += place * r.speed_rad_per_s[row];
    spread += place * place;
  }
  const Eigen::MatrixXd found = fit.normal.ldlt().solve(fit.right);
  made.speed_rad_per_s = speed / fit.sum;
  made.acceleration_rad_per_s2 = slope / spread / (rows * r.period_s());
  made.samples = fit.sum * fit.sum / fit.squares;
  made.time_s =
      0.5 *
      static_cast<double>(r.cycle[window.first] + r.cycle[window.last] - 2 * r.cycle.front()) *
      r.period_s();
  const std::complex<double> j(0.0, 1.0);
  const Eigen::VectorXcd amplitude = found.row(1).transpose() - j * found.row(2).transpose();
  made.position_m = amplitude.head(axes);
  made.current_a = amplitude.tail(axes);
  made.mean_position_m = found.row(0).head(axes).transpose();
  made.mean_current_a = found.row(0).tail(axes).transpose();
  return made;
}

}  // namespace

std::vector<TrackedWindow> TrackOrder(const session::Recording& recording,
                                      const OrderTrackRule& rule) {
  UsableRows usable{recording.cycle, recording.levitated, recording.speed_rad_per_s,
                    recording.angle_rad};
  for (std::size_t row = 0; row < usable.levitated.size(); ++row) {
    usable.levitated[row] = Usable(recording, row) ? 1 : 0;
  }
  TurnRule turns;
  turns.standstill_rad_per_s = rule.standstill_rad_per_s;
  turns.least_turns = rule.least_turns;
  turns.least_s = rule.least_s;
  turns.period_s = recording.period_s();
  std::vector<TrackedWindow> tracked;
  for (const TurnWindow& window : TurnWindows(usable, turns)) {
    tracked.push_back(FitWindow(recording, window));
  }
  return tracked;
}

}  // namespace levitas::analysis
