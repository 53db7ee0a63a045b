#include "diagnosis/record_errors/rotation_unit.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace levitas::diagnosis {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSame = 0.02;  ///< of a factor: 60 and 180/pi are 5 % apart
constexpr double kStretchS = 0.2;
constexpr double kFewestTurns = 3.0;  ///< in a stretch
constexpr double kOverOwn = 6.0;
constexpr double kStrong = 0.2;  ///< of the power of a stretch, with the right unit
constexpr double kWeak = 0.1;    ///< with the wrong one, at most
constexpr double kLine = 0.03;   ///< a weak one, that stands out from beside it
constexpr double kOverBeside = 6.0;

constexpr std::array kUnits{60.0,      1.0 / 60.0, 30.0 / kPi,  kPi / 30.0,
                            2.0 * kPi, 0.5 / kPi,  180.0 / kPi, kPi / 180.0};

/// Share of the readings' power in step with the speed's integral times `factor`; negative: too few
/// turns.
double InStep(const Columns& columns, double period_s, double factor) {
  const auto length = static_cast<Eigen::Index>(std::llround(kStretchS / period_s));
  double explained = 0.0;
  double power = 0.0;
  for (Eigen::Index from = 0; from + length <= columns.rows(); from += length) {
    Eigen::MatrixXd basis(length, 6);
    double angle = 0.0;
    bool whole = true;
    for (Eigen::Index i = 0; i < length; ++i) {
      const double t = 2.0 * static_cast<double>(i) / static_cast<double>(length) - 1.0;
      basis.row(i) << 1.0, t, t * t, t * t * t, std::cos(factor * angle), std::sin(factor * angle);
      angle += period_s * columns.speed_rad_per_s[from + i];
      whole = whole && (i == 0 || columns.missing[static_cast<std::size_t>(from + i)] == 0);
    }
    const double turns = std::abs(factor * angle) / (2.0 * kPi);
    // More than a third of a turn from row to row is no rotation of a rotor.
    if (!whole || turns < kFewestTurns || turns > static_cast<double>(length) / 3.0) continue;
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(basis);
    const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(length, 6);
    const Eigen::MatrixXd parts = q.transpose() * columns.position_m.middleRows(from, length);
    power +=
        columns.position_m.middleRows(from, length).squaredNorm() - parts.topRows(4).squaredNorm();
    explained += parts.bottomRows(2).squaredNorm();
  }
  return power > 0.0 ? explained / power : -1.0;
}

/// The same at speeds about it, on average: what moves the rotor without turning with it.
double Beside(const Columns& columns, double period_s, double factor) {
  constexpr std::array kAbout{0.6, 0.75, 1.33, 1.67};
  double sum = 0.0;
  for (const double about : kAbout) sum += std::max(0.0, InStep(columns, period_s, about * factor));
  return sum / static_cast<double>(kAbout.size());
}

double UnitNear(double factor) {
  for (const double unit : kUnits) {
    if (std::abs(factor / unit - 1.0) < kSame) return unit;
  }
  return 0.0;
}

/// Share of the rows from which on the angle, wrapped at 2 pi, goes on as the speed times `unit`
/// says. A unit of more than 1 may turn by more than half a turn from row to row, of which no
/// difference of angles tells how far it went.
double GoesOn(const Columns& columns, double period_s, double unit) {
  constexpr double kNear = 0.1;       // [rad]
  constexpr double kTurnsRad = 1e-3;  // from row to row
  std::size_t rows = 0;
  std::size_t near = 0;
  for (Eigen::Index n = 1; n < columns.rows(); ++n) {
    const double turned = period_s * columns.speed_rad_per_s[n - 1];
    if (columns.missing[static_cast<std::size_t>(n)] != 0 || std::abs(turned) < kTurnsRad) continue;
    const double passed = columns.angle_rad[n] - columns.angle_rad[n - 1];
    ++rows;
    if (std::abs(std::remainder(passed - unit * turned, 2.0 * kPi)) < kNear) ++near;
  }
  return rows > 0 ? static_cast<double>(near) / static_cast<double>(rows) : 0.0;
}

/// The unit in which an angle that turns too far from row to row goes on; 0: none.
double WrappedUnit(const Columns& columns, double period_s) {
  constexpr double kMost = 0.85;  // a sawtooth in the other unit jumps once a turn
  constexpr double kLittle = 0.2;
  if (GoesOn(columns, period_s, 1.0) > kLittle) return 0.0;
  double best = kMost;
  double found = 0.0;
  for (const double unit : kUnits) {
    const double share = unit > 1.0 ? GoesOn(columns, period_s, unit) : 0.0;
    if (share < best) continue;
    best = share;
    found = unit;
  }
  return found;
}

std::string Conversion(double factor) {
  const bool less = factor < 1.0;
  const double size = less ? 1.0 / factor : factor;
  if (size > 58.0) return less ? "rpm, not Hz" : "Hz, not rpm";
  if (size > 50.0) return less ? "degrees, not radians" : "radians, not degrees";
  if (size > 8.0) return less ? "rpm, not rad/s" : "rad/s, not rpm";
  return less ? "rad/s, not Hz" : "Hz, not rad/s";
}

void AddUnit(const std::string& column, double factor, double statistic, RecordErrors& out) {
  out.errors.push_back(
      {RecordErrorKind::kUnit,
       {column},
       factor,
       statistic,
       fmt::format("{} is in another unit: its numbers are {:.4g} times too {}", column,
                   factor > 1.0 ? factor : 1.0 / factor, factor > 1.0 ? "small" : "large"),
       fmt::format("they are {}: name the column by its unit, or unit in a map of columns",
                   Conversion(factor)),
       true});
}

}  // namespace

double AngleOverSpeed(const Columns& columns, double period_s) {
  constexpr int kRowsABlock = 50;
  std::vector<double> ratios;
  double turned = 0.0;
  double expected = 0.0;
  double all = 0.0;
  int rows = 0;
  for (Eigen::Index n = 1; n < columns.rows(); ++n) {
    if (columns.missing[static_cast<std::size_t>(n)] != 0) continue;
    turned += std::remainder(columns.angle_rad[n] - columns.angle_rad[n - 1], 2.0 * kPi);
    expected += period_s * columns.speed_rad_per_s[n - 1];
    if (++rows < kRowsABlock) continue;
    if (expected != 0.0) ratios.push_back(turned / expected);
    all += std::abs(expected);
    turned = expected = 0.0;
    rows = 0;
  }
  // Of a speed in another unit too: 5 rad of 300.
  if (all <= 1.0) return 0.0;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

void FindRotationUnit(const RigView& rig, const Columns& columns, RecordErrors& out) {
  const double period_s = rig.period_s;
  const double over = AngleOverSpeed(columns, period_s);
  if (over == 0.0) return;
  const double own = InStep(columns, period_s, 1.0);
  const double near = UnitNear(over);
  const double unit = near != 0.0 ? near : WrappedUnit(columns, period_s);
  if (unit != 0.0) {
    // The angle turns `unit` times as fast as the speed says: which of the two do readings follow?
    const double by_angle = InStep(columns, period_s, unit);
    if (by_angle >= own) {
      out.speed_factor = unit;
      AddUnit("speed", unit, by_angle / std::max(own, 1e-3), out);
    } else {
      out.angle_factor = 1.0 / unit;
      AddUnit("rotor_angle", 1.0 / unit, own / std::max(by_angle, 1e-3), out);
    }
    return;
  }
  if (own > kWeak || std::abs(over - 1.0) > kSame) return;
  double best = std::max(own, 0.0);
  double factor = 0.0;
  for (const double candidate : kUnits) {
    const double share = InStep(columns, period_s, candidate);
    if (share < kLine || share < kOverOwn * std::max(own, 1e-3) || share <= best) continue;
    if (share < kStrong && share < kOverBeside * Beside(columns, period_s, candidate)) continue;
    best = share;
    factor = candidate;
  }
  if (factor == 0.0) return;
  out.speed_factor = out.angle_factor = factor;
  const bool degrees = std::abs(std::log(factor) / std::log(180.0 / kPi)) > 0.98 &&
                       std::abs(std::log(factor) / std::log(180.0 / kPi)) < 1.005;
  AddUnit(degrees ? "rotor_angle" : "speed", factor, best / std::max(own, 1e-3), out);
}

}  // namespace levitas::diagnosis
