#include "analysis/synchronous.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "analysis/excited_rows.hpp"
#include "analysis/turn_windows.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::analysis {
namespace {

constexpr double kHeldS = 0.2;
constexpr double kHeldShare = 0.002;
constexpr double kHeldRadPerS = 0.25;
constexpr double kSteadyRadPerS2 = 0.5;  // slower changes count as steady, as in a report
constexpr double kLastS = 1.0;
constexpr double kPassedShare = 0.02;
/// Held stretches whose speeds differ by less are one speed of the record.
constexpr double kSameSpeed = 0.005;

bool SameSpeed(double one_rad_per_s, double other_rad_per_s) {
  return std::abs(one_rad_per_s - other_rad_per_s) <=
         std::max(kSameSpeed * one_rad_per_s, 2.0 * kHeldRadPerS);
}

/// 1, then cosine and sine of each order.
Eigen::VectorXd Basis(const std::vector<double>& orders, double angle_rad) {
  Eigen::VectorXd basis(1 + 2 * static_cast<Eigen::Index>(orders.size()));
  basis[0] = 1.0;
  Eigen::Index at = 1;
  for (const double order : orders) {
    basis[at++] = std::cos(order * angle_rad);
    basis[at++] = std::sin(order * angle_rad);
  }
  return basis;
}

/// Position and current of each axis from `first` on, in turn; the rotor's radius.
double ReadAxes(const session::Recording& recording, std::size_t first, std::size_t row,
                Eigen::RowVectorXd& values) {
  double square = 0.0;
  const auto axes = static_cast<std::size_t>(values.size()) / 2;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const double position_m = recording.position_m[first + axis][row];
    values[static_cast<Eigen::Index>(2 * axis)] = position_m;
    values[static_cast<Eigen::Index>(2 * axis + 1)] = recording.current_a[first + axis][row];
    square += position_m * position_m;
  }
  return std::sqrt(square);
}

}  // namespace

/// As turn_windows.hpp wants it.
struct SynchronousAnalysis::Quiet {
  const std::vector<std::uint64_t>& cycle;
  const std::vector<std::uint8_t>& levitated;
  const session::Column& speed_rad_per_s;
  const session::Column& angle_rad;
};

SynchronousAnalysis::SynchronousAnalysis(const session::Recording& recording,
                                         SynchronousRequest request)
    : recording_(recording), request_(std::move(request)), levitated_(recording.levitated) {
  for (const double order : request_.orders) {
    if (!(order > 0.0)) throw std::invalid_argument("synchronous: an order is above zero");
  }
  for (std::size_t row = 0; row < levitated_.size(); ++row) {
    if (!std::isfinite(recording.speed_rad_per_s[row]) || ExcitedAt(recording, row)) {
      levitated_[row] = 0;
    }
  }
  double slowest = 1.0;
  for (const double ratio : request_.shaft_ratio) slowest = std::min(slowest, std::abs(ratio));
  TurnRule rule;
  rule.standstill_rad_per_s = request_.standstill_rad_per_s;
  rule.turn_rad = 2.0 * std::numbers::pi / slowest;
  rule.period_s = recording.period_s();
  const Quiet quiet{recording.cycle, levitated_, recording.speed_rad_per_s, recording.angle_rad};
  for (const TurnWindow& window : TurnWindows(quiet, rule)) {
    windows_.push_back({window.first, window.last + 1});
  }
  FindHeld();
}

SynchronousAnalysis::Quiet SynchronousAnalysis::QuietRows() const {
  return {recording_.cycle, levitated_, recording_.speed_rad_per_s, recording_.angle_rad};
}

double SynchronousAnalysis::MeanSpeed(const session::RowRange& rows) const {
  double sum = 0.0;
  for (std::size_t row = rows.begin; row < rows.end; ++row) {
    sum += std::abs(recording_.speed_rad_per_s[row]);
  }
  return rows.end > rows.begin ? sum / static_cast<double>(rows.end - rows.begin) : 0.0;
}

void SynchronousAnalysis::FindHeld() {
  const auto least = static_cast<std::size_t>(std::ceil(kHeldS / recording_.period_s()));
  const auto speed = [&](std::size_t row) { return std::abs(recording_.speed_rad_per_s[row]); };
  std::size_t begin = 0;
  while (begin < levitated_.size()) {
    std::size_t end = begin;
    const double start = speed(begin);
    const double wide = std::max(kHeldShare * start, kHeldRadPerS);
    const auto stays = [&](std::size_t row) {
      if (levitated_[row] == 0) return false;
      if (row > begin && !recording_.Follows(row)) return false;
      return Standing(start) ? Standing(speed(row)) : std::abs(speed(row) - start) <= wide;
    };
    while (end < levitated_.size() && stays(end)) ++end;
    const std::size_t rows = end - begin;
    const double last = MeanSpeed({end - rows / 4, end});
    const double before = MeanSpeed({end - rows / 2, end - rows / 4});
    // A slow ramp goes through an eighth of the band in each eighth of the rows; a hold stays.
    const double quarter_s = 0.25 * static_cast<double>(rows) * recording_.period_s();
    const double drift = std::min(wide / 8.0, kSteadyRadPerS2 * quarter_s);
    const bool held = rows >= least && (Standing(start) || std::abs(last - before) < drift);
    if (held) held_.push_back({{begin, end}, Standing(start) ? 0.0 : last});
    begin = held ? end : begin + std::max<std::size_t>(1, rows / 8);
  }
  for (const Stretch& stretch : held_) held_rad_per_s_.push_back(stretch.speed_rad_per_s);
  std::sort(held_rad_per_s_.begin(), held_rad_per_s_.end());
  held_rad_per_s_.erase(std::unique(held_rad_per_s_.begin(), held_rad_per_s_.end(), SameSpeed),
                        held_rad_per_s_.end());
}

/// Of its last second as much as is whole turns; all of it of a rotor that stands.
session::RowRange SynchronousAnalysis::LastWholeTurns(const session::RowRange& rows) const {
  const auto most = static_cast<std::size_t>(std::lround(kLastS / recording_.period_s()));
  session::RowRange last{rows.end - std::min(most, rows.end - rows.begin), rows.end};
  double turned_rad = 0.0;
  std::size_t end = last.begin;
  double wanted_rad = 2.0 * std::numbers::pi;
  const Quiet quiet = QuietRows();
  for (std::size_t row = last.begin + 1; row < last.end; ++row) {
    turned_rad += AngleStep(quiet, row);
    if (!(std::abs(turned_rad) >= wanted_rad)) continue;
    end = row;
    wanted_rad += 2.0 * std::numbers::pi;
  }
  if (end > last.begin) last.end = end;
  return last;
}

std::optional<session::RowRange> SynchronousAnalysis::Passed(double speed_rad_per_s) const {
  std::optional<session::RowRange> nearest;
  double nearest_off = kPassedShare * speed_rad_per_s;
  for (const session::RowRange& window : windows_) {
    const double mean = 0.5 * std::abs(recording_.speed_rad_per_s[window.begin] +
                                       recording_.speed_rad_per_s[window.end - 1]);
    const double off = std::abs(mean - speed_rad_per_s);
    if (off > nearest_off) continue;
    nearest = window;
    nearest_off = off;
  }
  return nearest;
}

void SynchronousAnalysis::FitBearing(std::size_t bearing, SynchronousRows& made) const {
  const bool turning = !Standing(made.speed_rad_per_s);
  const std::vector<double> orders = turning ? request_.orders : std::vector<double>{};
  const double ratio = bearing < request_.shaft_ratio.size() ? request_.shaft_ratio[bearing] : 1.0;
  const std::size_t first = bearing * request_.axes_per_bearing;
  const std::size_t axes = std::min(request_.axes_per_bearing, recording_.axes() - first);
  const auto signals = static_cast<Eigen::Index>(2 * axes);
  const auto size = 1 + 2 * static_cast<Eigen::Index>(orders.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(size, signals);
  Eigen::RowVectorXd values(signals);
  const Quiet quiet = QuietRows();
  double angle_rad = 0.0;
  double radius_m = 0.0;
  for (std::size_t row = made.rows.begin; row < made.rows.end; ++row) {
    if (row > made.rows.begin) angle_rad += ratio * AngleStep(quiet, row);
    radius_m = std::max(radius_m, ReadAxes(recording_, first, row, values));
    const Eigen::VectorXd basis = Basis(orders, angle_rad);
    normal.noalias() += basis * basis.transpose();
    right.noalias() += basis * values;
  }
  made.largest_radius_m.push_back(radius_m);
  const Eigen::MatrixXd weights = normal.ldlt().solve(right);
  const double nyquist_rad_per_s = std::numbers::pi / recording_.period_s();
  for (Eigen::Index signal = 0; signal < signals; ++signal) {
    OrderAmplitudes found;
    found.mean = weights(0, signal);
    for (std::size_t k = 0; k < orders.size(); ++k) {
      const auto at = 1 + 2 * static_cast<Eigen::Index>(k);
      const bool seen = orders[k] * std::abs(ratio) * made.speed_rad_per_s < nyquist_rad_per_s;
      found.amplitude.push_back(seen ? std::hypot(weights(at, signal), weights(at + 1, signal))
                                     : std::numeric_limits<double>::quiet_NaN());
    }
    (signal % 2 == 0 ? made.position_m : made.current_a).push_back(std::move(found));
  }
}

SynchronousRows SynchronousAnalysis::Fit(const session::RowRange& rows) const {
  SynchronousRows made;
  made.rows = rows;
  const Quiet quiet = QuietRows();
  double turned_rad = 0.0;
  for (std::size_t row = rows.begin + 1; row < rows.end; ++row) {
    turned_rad += AngleStep(quiet, row);
  }
  made.speed_rad_per_s = MeanSpeed(rows);
  made.turns = std::abs(turned_rad) / (2.0 * std::numbers::pi);
  for (std::size_t b = 0; b * request_.axes_per_bearing < recording_.axes(); ++b) {
    FitBearing(b, made);
  }
  return made;
}

std::optional<SynchronousRows> SynchronousAnalysis::At(double speed_rad_per_s) const {
  const bool standing = Standing(speed_rad_per_s);
  const Stretch* longest = nullptr;
  const auto rows = [](const Stretch& s) { return s.rows.end - s.rows.begin; };
  for (const Stretch& stretch : held_) {
    const bool is_it = standing ? Standing(stretch.speed_rad_per_s)
                                : !Standing(stretch.speed_rad_per_s) &&
                                      SameSpeed(speed_rad_per_s, stretch.speed_rad_per_s);
    if (is_it && (longest == nullptr || rows(stretch) >= rows(*longest))) longest = &stretch;
  }
  if (longest != nullptr) {
    SynchronousRows made = Fit(LastWholeTurns(longest->rows));
    made.held = true;
    return made;
  }
  if (standing) return std::nullopt;
  const auto passed = Passed(speed_rad_per_s);
  if (!passed) return std::nullopt;
  return Fit(*passed);
}

std::vector<SynchronousRows> SynchronousAnalysis::OverSpeed() const {
  std::vector<SynchronousRows> made;
  made.reserve(windows_.size());
  for (const session::RowRange& window : windows_) made.push_back(Fit(window));
  return made;
}

}  // namespace levitas::analysis
