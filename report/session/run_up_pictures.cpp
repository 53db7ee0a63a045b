// Run-up and run-down: Bode of the synchronous vibration, and the full spectrum as a waterfall.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "analysis/full_spectrum.hpp"
#include "common/rotational_speed.hpp"
#include "report/session/pictures.hpp"

namespace levitas::report {
namespace {

constexpr std::size_t kSpectrumLength = 4096;
constexpr std::size_t kSpectra = 32;
constexpr double kOrdersShown = 2.5;
constexpr double kLeastShownHz = 100.0;
constexpr double kTallest = 0.22;  ///< of the speed range, the highest line
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// From the slowest on, so that the phases of both directions begin alike.
std::vector<SynchronousPoint> BySpeed(const std::vector<SynchronousPoint>& points, Ramp ramp) {
  std::vector<SynchronousPoint> chosen;
  std::copy_if(points.begin(), points.end(), std::back_inserter(chosen),
               [&](const auto& point) { return point.ramp == ramp; });
  std::sort(chosen.begin(), chosen.end(),
            [](const auto& a, const auto& b) { return a.speed_rad_per_s < b.speed_rad_per_s; });
  return chosen;
}

svg::Series Curve(const std::vector<SynchronousPoint>& points, std::size_t bearing, Ramp ramp,
                  bool phase) {
  svg::Series series;
  series.name = ramp == Ramp::kUp ? "run-up" : "run-down";
  series.colour = svg::Colour(ramp == Ramp::kUp ? 0 : 1);
  if (ramp == Ramp::kDown) series.dashes = "5 2";
  double before_deg = 0.0;
  for (const SynchronousPoint& point : BySpeed(points, ramp)) {
    const auto forward = point.forward_m[bearing];
    double value = std::abs(forward) * kUm;
    if (phase) {
      // Continuous: a phase that passes 180 degrees has not jumped.
      value = std::arg(forward) * kDegrees;
      if (!series.y.empty()) value = before_deg + std::remainder(value - before_deg, 360.0);
      before_deg = value;
    }
    series.x.push_back(RadPerSToRpm(point.speed_rad_per_s));
    series.y.push_back(value);
  }
  return series;
}

NamedPicture Bode(const Recording& r, const std::vector<SynchronousPoint>& points,
                  std::size_t bearing) {
  const std::string& name = r.rig.bearings[bearing];
  const bool geared = !r.shaft_ratio.empty();
  const char* const speed = geared ? "speed of the first shaft, rpm" : "speed, rpm";
  svg::Panel size{geared ? fmt::format("vibration with its own shaft (its 1X), {}", name)
                         : fmt::format("synchronous vibration (1X forward), {}", name),
                  speed, "amplitude, µm"};
  svg::Panel phase{geared ? "phase to its shaft's mark" : "phase to the rotor's mark", speed,
                   "phase, degrees"};
  for (const Ramp ramp : {Ramp::kUp, Ramp::kDown}) {
    svg::Series curve = Curve(points, bearing, ramp, false);
    if (curve.x.size() < 2) continue;
    size.series.push_back(std::move(curve));
    phase.series.push_back(Curve(points, bearing, ramp, true));
    phase.series.back().name.clear();  // said above
  }
  double largest_um = 0.0;
  for (const svg::Series& curve : size.series) {
    for (const double y : curve.y) largest_um = std::fmax(largest_um, y);
  }
  size.y_range = svg::Range{0.0, std::max(1.15 * largest_um, 0.1)};
  svg::Figure figure = Wide(std::move(size));
  figure.panel_height = 200;
  figure.panels.push_back(std::move(phase));
  return {fmt::format("bode_{}", name),
          geared ? fmt::format("Radius and phase of the circle that turns with the shaft of {}, at "
                               "{:.4g} times the speed of the first, over that speed.",
                               name, r.RatioOf(bearing))
                 : fmt::format("Radius and phase of the forward circle that turns with the rotor "
                               "at {}, over speed.",
                               name),
          std::move(figure)};
}

/// Middles of the spectra: where each of evenly spaced speeds was first reached.
std::vector<std::size_t> Instants(const std::vector<SynchronousPoint>& points) {
  const bool up = std::any_of(points.begin(), points.end(),
                              [](const auto& point) { return point.ramp == Ramp::kUp; });
  double top = 0.0;
  for (const auto& point : points) top = std::max(top, point.speed_rad_per_s);
  std::vector<std::size_t> instants;
  double next = 0.0;
  for (const auto& point : points) {
    if (point.ramp != (up ? Ramp::kUp : Ramp::kDown)) continue;
    const double gone = up ? point.speed_rad_per_s : top - point.speed_rad_per_s;
    if (gone < next) continue;
    instants.push_back(point.index);
    next = std::max(next, gone) + top / kSpectra;
  }
  return instants;
}

std::vector<double> SpectrumAt(const Recording& r, std::size_t bearing, std::size_t middle,
                               std::size_t lines) {
  if (middle < kSpectrumLength / 2 || middle + kSpectrumLength / 2 > r.size()) return {};
  const std::size_t first = middle - kSpectrumLength / 2;
  if (!r.Uninterrupted(first, first + kSpectrumLength - 1)) return {};
  std::vector<std::complex<double>> orbit;
  orbit.reserve(kSpectrumLength);
  for (std::size_t i = first; i < first + kSpectrumLength; ++i) {
    const std::complex<double> at{static_cast<double>(r.position_m[2 * bearing][i]),
                                  static_cast<double>(r.position_m[2 * bearing + 1][i])};
    if (!r.levitated[i] || !std::isfinite(at.real()) || !std::isfinite(at.imag())) return {};
    orbit.push_back(at);
  }
  return analysis::FullAmplitudes(std::move(orbit), lines);
}

/// A line of constant order: its frequency grows with the speed.
svg::Series OrderLine(double order, double top_rpm) {
  svg::Series line = Level("", 0.0, order * top_rpm / 60.0, 0.0);
  line.y = {0.0, top_rpm};
  line.colour = "#999999";
  return line;
}

struct Spectrum {
  double speed_rpm{};
  std::vector<double> amplitude_m;
};

svg::Series Line(const Spectrum& spectrum, double line_hz, double rpm_per_m) {
  svg::Series series;
  series.width = 0.9;
  const double lines = 0.5 * static_cast<double>(spectrum.amplitude_m.size() - 1);
  for (std::size_t k = 0; k < spectrum.amplitude_m.size(); ++k) {
    series.x.push_back((static_cast<double>(k) - lines) * line_hz);
    series.y.push_back(spectrum.speed_rpm + spectrum.amplitude_m[k] * rpm_per_m);
  }
  return series;
}

NamedPicture Waterfall(const Recording& r, const std::vector<SynchronousPoint>& points,
                       std::size_t bearing) {
  const double top_rpm = RadPerSToRpm(r.top_speed_rad_per_s);
  const double line_hz = 1.0 / (r.rig.period_s() * static_cast<double>(kSpectrumLength));
  const double shown_hz = std::max(kLeastShownHz, kOrdersShown * top_rpm / 60.0);
  const auto lines = static_cast<std::size_t>(shown_hz / line_hz);
  std::vector<Spectrum> spectra;
  double highest_m = 0.0;
  for (const std::size_t middle : Instants(points)) {
    const double speed = std::abs(static_cast<double>(r.speed_rad_per_s[middle]));
    Spectrum spectrum{RadPerSToRpm(speed), SpectrumAt(r, bearing, middle, lines)};
    if (spectrum.amplitude_m.empty()) continue;
    for (const double amplitude : spectrum.amplitude_m) highest_m = std::max(highest_m, amplitude);
    spectra.push_back(std::move(spectrum));
  }
  const std::string& name = r.rig.bearings[bearing];
  svg::Panel panel{
      fmt::format("full spectrum over speed, {}: highest line {:.1f} µm", name, highest_m * kUm),
      "frequency, Hz (negative: backward whirl)", "speed, rpm"};
  for (const double order : {-2.0, -1.0, 1.0, 2.0}) {
    panel.series.push_back(OrderLine(order, top_rpm));
  }
  const double rpm_per_m = highest_m > 0.0 ? kTallest * top_rpm / highest_m : 0.0;
  // The fastest first: what is slower stands before it.
  for (auto s = spectra.rbegin(); s != spectra.rend(); ++s) {
    panel.series.push_back(Line(*s, line_hz, rpm_per_m));
  }
  panel.x_range = svg::Range{-shown_hz, shown_hz};
  panel.y_range = svg::Range{0.0, (1.05 + kTallest) * top_rpm};
  svg::Figure figure = Wide(std::move(panel));
  figure.panel_height = 400;
  return {fmt::format("waterfall_{}", name),
          fmt::format("Full spectra of the orbit at {} over the run, each standing on its speed; "
                      "dashed: one and two times the speed of rotation.",
                      name),
          std::move(figure)};
}

}  // namespace

std::vector<NamedPicture> RunUpPictures(const Recording& recording,
                                        const std::vector<SynchronousPoint>& points) {
  const auto ramps = std::count_if(points.begin(), points.end(),
                                   [](const auto& p) { return p.ramp != Ramp::kSteady; });
  std::vector<NamedPicture> pictures;
  if (ramps < 4) return pictures;  // no run-up, and no line through fewer points
  for (std::size_t b = 0; b < recording.rig.bearings.size(); ++b) {
    pictures.push_back(Bode(recording, points, b));
  }
  for (std::size_t b = 0; b < recording.rig.bearings.size(); ++b) {
    pictures.push_back(Waterfall(recording, points, b));
  }
  return pictures;
}

}  // namespace levitas::report
