#include "analysis/sensitivity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "analysis/loop_response.hpp"
#include "analysis/poles.hpp"
#include "analysis/sampled_loop.hpp"
#include "analysis/sensitivity_curves.hpp"
#include "numerics/dense/spectrum.hpp"

namespace levitas::analysis {
namespace {

constexpr double kLowestHz = 0.1;
constexpr double kPointsPerDecade = 150.0;
/// Below that for gain crossings alone: a slow integrator may turn the loop round down there, and
/// nothing resonates.
constexpr double kLowestCrossingHz = 1e-4;
constexpr double kCrossingPointsPerDecade = 10.0;
/// A loop gain beyond this is an integrator's, and no crossing at a finite gain.
constexpr double kLargestLoopGain = 1e6;
/// Poles less damped than this get grid points of their own: their resonance may be narrower than
/// the grid.
constexpr double kLightDamping = 0.5;
/// Local maxima of the grid within this share of the largest are refined: a narrow peak between
/// two grid points can hide more than it shows.
constexpr double kRefineFrom = 0.7;

struct GridPoint {
  double frequency_hz{};
  Eigen::VectorXcd diagonal;  ///< S_ii
  double singular_value{};
};

GridPoint Evaluate(const LoopResponse& response, double frequency_hz) {
  const Eigen::MatrixXcd s = response.Sensitivity(frequency_hz);
  return {frequency_hz, s.diagonal(), LargestSingularValue(s)};
}

std::vector<double> GridFrequencies(const LoopPoles& poles, double nyquist_hz) {
  std::vector<double> grid_hz;
  const double ratio = std::pow(10.0, 1.0 / kPointsPerDecade);
  for (double f = kLowestHz; f < nyquist_hz; f *= ratio) grid_hz.push_back(f);
  grid_hz.push_back(nyquist_hz);
  constexpr std::array kHalfWidths{-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0};
  for (const Pole& pole : poles.poles) {
    const double damping = std::abs(pole.damping_ratio);
    if (damping > kLightDamping) continue;
    for (const double widths : kHalfWidths) {
      const double f = std::abs(pole.frequency_hz) * (1.0 + widths * damping);
      if (f > kLowestHz && f < nyquist_hz) grid_hz.push_back(f);
    }
  }
  std::sort(grid_hz.begin(), grid_hz.end());
  grid_hz.erase(std::unique(grid_hz.begin(), grid_hz.end()), grid_hz.end());
  return grid_hz;
}

/// Frequencies at which a resonance at s has turned by equal angles: 1/S turns so about poles of
/// the plant, between two points of a grid that is made for the closed loop.
void AddCircle(std::complex<double> s_rad_per_s, std::vector<double>& grid_hz) {
  constexpr int kPoints = 18;
  if (std::abs(s_rad_per_s.real()) > kLightDamping * std::abs(s_rad_per_s)) return;
  for (int i = 1; i < kPoints; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / kPoints - 0.5);
    const double at_rad_per_s = s_rad_per_s.imag() + s_rad_per_s.real() * std::tan(angle);
    grid_hz.push_back(at_rad_per_s / (2.0 * std::numbers::pi));
  }
}

struct CurvePoint {
  double frequency_hz{};
  Eigen::VectorXcd diagonal;
};

/// With a point between every two whose loops lie apart, near enough to -1 to be looked at.
std::vector<CurvePoint> Finer(const LoopResponse& response, const std::vector<CurvePoint>& points) {
  constexpr double kApart = 0.15;
  constexpr double kLookedAt = 5.0;
  std::vector<CurvePoint> finer{points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::ArrayXcd before = points[i - 1].diagonal.array().inverse() - 1.0;
    const Eigen::ArrayXcd after = points[i].diagonal.array().inverse() - 1.0;
    const Eigen::ArrayXd apart = (after - before).abs();
    if ((apart > kApart && before.abs().min(after.abs()) < kLookedAt).any()) {
      const double f = std::sqrt(points[i - 1].frequency_hz * points[i].frequency_hz);
      finer.push_back({f, response.Sensitivity(f).diagonal()});
    }
    finer.push_back(points[i]);
  }
  return finer;
}

/// From z = 1 itself, where every loop without an integrator is real, to the lowest peak counted.
std::vector<GridPoint> CrossingPoints(const LoopResponse& response) {
  std::vector<GridPoint> points{Evaluate(response, 0.0)};
  const double ratio = std::pow(10.0, 1.0 / kCrossingPointsPerDecade);
  for (double f = kLowestCrossingHz; f < kLowestHz; f *= ratio) {
    points.push_back(Evaluate(response, f));
  }
  return points;
}

struct Peak {
  double value{};
  double frequency_hz{};
};

/// Golden section for the maximum between two frequencies; stops when the place is known to 1e-7,
/// where the value, flat at its top, is known to better than 1e-6.
Peak Refine(const std::function<double(double)>& value_at, double low_hz, double high_hz) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double left_hz = high_hz - golden * (high_hz - low_hz);
  double right_hz = low_hz + golden * (high_hz - low_hz);
  double left = value_at(left_hz);
  double right = value_at(right_hz);
  while (high_hz - low_hz > 1e-7 * high_hz) {
    if (left > right) {
      high_hz = right_hz;
      right_hz = left_hz;
      right = left;
      left_hz = high_hz - golden * (high_hz - low_hz);
      left = value_at(left_hz);
    } else {
      low_hz = left_hz;
      left_hz = right_hz;
      left = right;
      right_hz = low_hz + golden * (high_hz - low_hz);
      right = value_at(right_hz);
    }
  }
  return left > right ? Peak{left, left_hz} : Peak{right, right_hz};
}

using Measure = std::function<double(const GridPoint&)>;

Peak LargestPeak(const LoopResponse& response, const std::vector<GridPoint>& grid,
                 const Measure& measure) {
  Peak best;
  for (const GridPoint& point : grid) {
    if (measure(point) > best.value) best = {measure(point), point.frequency_hz};
  }
  const double threshold = kRefineFrom * best.value;
  for (std::size_t i = 1; i + 1 < grid.size(); ++i) {
    const double here = measure(grid[i]);
    if (here < threshold || here < measure(grid[i - 1]) || here < measure(grid[i + 1])) continue;
    const Peak refined = Refine([&](double f) { return measure(Evaluate(response, f)); },
                                grid[i - 1].frequency_hz, grid[i + 1].frequency_hz);
    if (refined.value > best.value) best = refined;
  }
  return best;
}

std::complex<double> OpenLoop(const GridPoint& point, Eigen::Index axis) {
  return 1.0 / point.diagonal[axis] - 1.0;
}

/// Where `value` (of the loop of one axis) changes sign between two grid points.
std::complex<double> Crossing(const LoopResponse& response, Eigen::Index axis, double low_hz,
                              double high_hz,
                              const std::function<double(std::complex<double>)>& value,
                              double& frequency_hz) {
  const auto loop_at = [&](double f) { return 1.0 / response.Sensitivity(f)(axis, axis) - 1.0; };
  const bool rising = value(loop_at(low_hz)) < 0.0;
  for (int halvings = 0; halvings < 40; ++halvings) {
    frequency_hz = 0.5 * (low_hz + high_hz);
    ((value(loop_at(frequency_hz)) < 0.0) == rising ? low_hz : high_hz) = frequency_hz;
  }
  return loop_at(frequency_hz);
}

void TakeGainCrossing(double real_part, AxisMargins& margins) {
  if (real_part >= 0.0) return;
  const double factor = -1.0 / real_part;
  if (factor > 1.0) {
    margins.gain_up = std::min(factor, margins.gain_up.value_or(factor));
  } else {
    margins.gain_down = std::max(factor, margins.gain_down.value_or(factor));
  }
}

void TakePhaseCrossing(std::complex<double> loop, double frequency_hz, AxisMargins& margins) {
  const double phase_rad = std::abs(std::arg(-loop));
  if (phase_rad >= margins.phase_rad.value_or(2.0 * std::numbers::pi)) return;
  margins.phase_rad = phase_rad;
  margins.phase_at_hz = frequency_hz;
}

/// At z = 1 and z = -1 every loop is real: a crossing there shows in no change of sign.
void TakeRealEnd(std::complex<double> loop, AxisMargins& margins) {
  if (std::isfinite(loop.real()) && std::abs(loop) < kLargestLoopGain) {
    TakeGainCrossing(loop.real(), margins);
  }
}

/// `grid` begins at z = 1 and ends at z = -1.
AxisMargins MarginsOf(const LoopResponse& response, const std::vector<GridPoint>& grid,
                      Eigen::Index axis) {
  const auto imaginary = [](std::complex<double> l) { return l.imag(); };
  const auto excess = [](std::complex<double> l) { return std::norm(l) - 1.0; };
  AxisMargins margins;
  double frequency_hz = 0.0;
  TakeRealEnd(OpenLoop(grid.front(), axis), margins);
  TakeRealEnd(OpenLoop(grid.back(), axis), margins);
  for (std::size_t i = 2; i < grid.size(); ++i) {
    const std::complex<double> before = OpenLoop(grid[i - 1], axis);
    const std::complex<double> after = OpenLoop(grid[i], axis);
    const double low_hz = grid[i - 1].frequency_hz;
    const double high_hz = grid[i].frequency_hz;
    if (before.imag() * after.imag() < 0.0 && std::min(before.real(), after.real()) < 0.0) {
      TakeGainCrossing(Crossing(response, axis, low_hz, high_hz, imaginary, frequency_hz).real(),
                       margins);
    }
    if (excess(before) * excess(after) < 0.0) {
      const auto loop = Crossing(response, axis, low_hz, high_hz, excess, frequency_hz);
      TakePhaseCrossing(loop, frequency_hz, margins);
    }
  }
  return margins;
}

}  // namespace

std::string_view Name(Zone zone) noexcept {
  constexpr std::array<std::string_view, 4> kNames{"A", "B", "C", "D"};
  return kNames[static_cast<std::size_t>(zone)];
}

Zone ZoneOf(double sensitivity_peak) noexcept {
  if (sensitivity_peak < 3.0) return Zone::kA;
  if (sensitivity_peak < 4.0) return Zone::kB;
  return sensitivity_peak < 5.0 ? Zone::kC : Zone::kD;
}

SensitivityResult SensitivityPeaks(const plant::PlantConfig& plant, const law::LawConfig& law,
                                   double speed_rad_per_s) {
  return SensitivityPeaks(CloseLoop(plant, law, speed_rad_per_s), speed_rad_per_s);
}

SensitivityResult SensitivityPeaks(const SampledLoop& loop, double speed_rad_per_s) {
  const LoopPoles poles = PolesOf(loop, speed_rad_per_s);
  const LoopResponse response(loop);
  std::vector<GridPoint> grid;
  for (const double f : GridFrequencies(poles, response.nyquist_hz())) {
    grid.push_back(Evaluate(response, f));
  }
  std::vector<GridPoint> whole = CrossingPoints(response);
  whole.insert(whole.end(), grid.begin(), grid.end());
  SensitivityResult result;
  result.speed_rad_per_s = speed_rad_per_s;
  result.stable = poles.stable;
  result.point = poles.point;
  result.largest_pole_modulus = poles.largest_pole_modulus;
  double worst = 0.0;
  for (std::size_t i = 0; i < response.axes(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const Peak peak = LargestPeak(
        response, grid, [axis](const GridPoint& point) { return std::abs(point.diagonal[axis]); });
    AxisSensitivity entry;
    entry.peak = peak.value;
    entry.frequency_hz = peak.frequency_hz;
    if (result.stable) {
      entry.zone = ZoneOf(peak.value);
      entry.margins = MarginsOf(response, whole, axis);
    }
    worst = std::max(worst, peak.value);
    result.axes.push_back(entry);
  }
  const Peak norm =
      LargestPeak(response, grid, [](const GridPoint& point) { return point.singular_value; });
  result.largest_singular_value = norm.value;
  result.largest_singular_value_hz = norm.frequency_hz;
  if (result.stable) result.zone = ZoneOf(worst);
  return result;
}

std::vector<std::vector<double>> SensitivityAt(const plant::PlantConfig& plant,
                                               const law::LawConfig& law, double speed_rad_per_s,
                                               const std::vector<double>& frequencies_hz) {
  const LoopResponse response(CloseLoop(plant, law, speed_rad_per_s));
  std::vector<std::vector<double>> rows;
  for (const double f : frequencies_hz) {
    const Eigen::VectorXd diagonal = response.Sensitivity(f).diagonal().cwiseAbs();
    rows.emplace_back(diagonal.begin(), diagonal.end());
  }
  return rows;
}

SensitivityCurves CurvesOf(const plant::PlantConfig& plant, const law::LawConfig& law,
                           double speed_rad_per_s) {
  const SampledLoop loop = CloseLoop(plant, law, speed_rad_per_s);
  const LoopResponse response(loop);
  std::vector<double> grid_hz =
      GridFrequencies(PolesOf(loop, speed_rad_per_s), response.nyquist_hz());
  for (const std::complex<double> z : numerics::EigenvaluesOf(loop.plant.a)) {
    if (z.imag() > 0.0) AddCircle(std::log(z) / loop.period_s, grid_hz);
  }
  std::erase_if(grid_hz, [&](double f) { return f < kLowestHz || f > response.nyquist_hz(); });
  std::sort(grid_hz.begin(), grid_hz.end());
  grid_hz.erase(std::unique(grid_hz.begin(), grid_hz.end()), grid_hz.end());
  std::vector<CurvePoint> points;
  for (const double f : grid_hz) points.push_back({f, response.Sensitivity(f).diagonal()});
  constexpr int kHalvings = 6;
  for (int i = 0; i < kHalvings; ++i) points = Finer(response, points);
  SensitivityCurves curves;
  curves.axes.resize(response.axes());
  for (const CurvePoint& point : points) {
    curves.frequency_hz.push_back(point.frequency_hz);
    for (std::size_t i = 0; i < curves.axes.size(); ++i) {
      curves.axes[i].push_back(point.diagonal[static_cast<Eigen::Index>(i)]);
    }
  }
  return curves;
}

}  // namespace levitas::analysis
