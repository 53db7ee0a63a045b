// Orbits at chosen speeds: inside the clearance, and enlarged.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <optional>

#include "common/rotational_speed.hpp"
#include "report/session/pictures.hpp"

namespace levitas::report {
namespace {

constexpr std::size_t kMostPoints = 600;
constexpr double kStandingS = 0.1;  // of a rotor that does not turn

struct Stretch {
  std::size_t first{}, last{};
};

/// Two turns that end where the speed was nearest to the wanted one; of equally near ones the last.
std::optional<Stretch> Nearest(const Recording& r, double speed_rad_per_s) {
  const double near = std::max(0.001 * speed_rad_per_s, 0.05 * r.standstill_rad_per_s);
  const auto away = [&](std::size_t i) {
    const double off =
        std::abs(std::abs(static_cast<double>(r.speed_rad_per_s[i])) - speed_rad_per_s);
    return std::max(off, near);  // nearer than that is the same
  };
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (r.levitated[i] && (!best || away(i) <= away(*best))) best = i;
  }
  if (!best) return std::nullopt;
  const double speed = std::abs(static_cast<double>(r.speed_rad_per_s[*best]));
  const double seconds =
      speed > r.standstill_rad_per_s ? std::min(4.0 * std::numbers::pi / speed, 1.0) : kStandingS;
  const auto wanted = static_cast<std::size_t>(std::ceil(seconds / r.rig.period_s()));
  Stretch stretch{*best - std::min(*best, wanted), *best};
  while (!r.Uninterrupted(stretch.first, stretch.last) || !r.levitated[stretch.first]) {
    ++stretch.first;
  }
  return stretch;
}

svg::Series Path(const Recording& r, std::size_t bearing, const Stretch& stretch,
                 std::size_t number) {
  svg::Series path;
  const double speed = std::abs(static_cast<double>(r.speed_rad_per_s[stretch.last]));
  path.name =
      speed > r.standstill_rad_per_s ? fmt::format("{:.0f} rpm", RadPerSToRpm(speed)) : "standing";
  path.colour = svg::Colour(number);
  const std::size_t step = (stretch.last - stretch.first) / kMostPoints + 1;
  for (std::size_t i = stretch.first; i <= stretch.last; i += step) {
    path.x.push_back(static_cast<double>(r.position_m[2 * bearing][i]) * kUm);
    path.y.push_back(static_cast<double>(r.position_m[2 * bearing + 1][i]) * kUm);
  }
  return path;
}

/// Where the mark of the first shaft passes; nothing for bearings of another shaft, whose angle the
/// record does not have.
svg::Series KeyPhasor(const Recording& r, std::size_t bearing, const Stretch& stretch,
                      const std::string& colour) {
  svg::Series dots{.colour = colour, .width = 0.0, .mark = svg::Mark::kDot, .mark_size = 4.5};
  if (r.RatioOf(bearing) != 1.0) return dots;
  const auto turn = [&](std::size_t i) {
    return std::floor(static_cast<double>(r.angle_rad[i]) / (2.0 * std::numbers::pi));
  };
  for (std::size_t i = stretch.first + 1; i <= stretch.last; ++i) {
    // An angle that starts anew after each turn jumps back; one that is counted on passes a whole.
    const bool passes = std::abs(r.angle_rad[i] - r.angle_rad[i - 1]) > std::numbers::pi_v<float>;
    if (!passes && turn(i) == turn(i - 1)) continue;
    dots.x.push_back(static_cast<double>(r.position_m[2 * bearing][i]) * kUm);
    dots.y.push_back(static_cast<double>(r.position_m[2 * bearing + 1][i]) * kUm);
  }
  return dots;
}

/// The way an orbit of two turns goes round: a head upon it, from the mean place of a sixteenth of
/// a turn to that of the next, so that noise does not turn it.
std::optional<svg::Series> Arrow(const svg::Series& path, double reach_um) {
  const std::size_t window = path.x.size() / 32;
  if (window == 0) return std::nullopt;
  const std::size_t at = path.x.size() / 5;
  const auto mean = [&](const std::vector<double>& values, std::size_t first) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(first);
    return std::accumulate(from, from + static_cast<std::ptrdiff_t>(window), 0.0) /
           static_cast<double>(window);
  };
  const std::complex<double> tail{mean(path.x, at), mean(path.y, at)};
  const std::complex<double> head{mean(path.x, at + window), mean(path.y, at + window)};
  const double length = std::abs(head - tail);
  if (length < 0.01 * reach_um) return std::nullopt;
  const std::complex<double> along = 0.07 * reach_um / length * (head - tail);
  const std::complex<double> across = 0.5 * along * std::complex<double>(0.0, 1.0);
  const std::complex<double> middle = 0.5 * (head + tail);
  svg::Series arrow{.colour = "#000000", .width = 1.4, .fill = path.colour};
  for (const auto& corner : {middle + along, middle - along + across, middle - along - across}) {
    arrow.x.push_back(corner.real());
    arrow.y.push_back(corner.imag());
  }
  return arrow;
}

/// The drawing area is square, so that a circle looks like one.
svg::Figure Square(svg::Panel panel) {
  svg::Figure figure = Wide(std::move(panel));
  figure.panel_width = 394;   // 74 of it beside the drawing area
  figure.panel_height = 386;  // 66 of it above and below
  return figure;
}

NamedPicture InClearance(const Recording& r, std::size_t bearing,
                         const std::vector<svg::Series>& paths) {
  const double clearance_um = r.rig.ClearanceOf(bearing) * kUm;
  const std::string& name = r.rig.bearings[bearing];
  svg::Panel panel{fmt::format("orbits in the clearance, {}", name), "x, µm", "y, µm"};
  panel.x_range = panel.y_range = svg::Range{-1.1 * clearance_um, 1.1 * clearance_um};
  panel.series = {Circle(clearance_um, "", ""), Circle(0.3 * clearance_um, "", "2 3"),
                  Circle(0.4 * clearance_um, "", "2 3"), Circle(0.5 * clearance_um, "", "2 3")};
  panel.series.insert(panel.series.end(), paths.begin(), paths.end());
  return {fmt::format("orbit_{}", name),
          fmt::format("Two turns at the sensors of {} inside the clearance; dotted: borders of "
                      "the zones A, B and C (0.3, 0.4 and 0.5 of the clearance).",
                      name),
          Square(std::move(panel))};
}

NamedPicture Enlarged(const Recording& r, std::size_t bearing,
                      const std::vector<svg::Series>& paths,
                      const std::vector<Stretch>& stretches) {
  const std::string& name = r.rig.bearings[bearing];
  svg::Panel panel{fmt::format("the same enlarged, {}", name), "x, µm", "y, µm"};
  double reach = 1.0;
  for (const svg::Series& path : paths) {
    for (std::size_t i = 0; i < path.x.size(); ++i) {
      reach = std::fmax(reach, std::fmax(std::abs(path.x[i]), std::abs(path.y[i])));
    }
  }
  panel.x_range = panel.y_range = svg::Range{-1.15 * reach, 1.15 * reach};
  panel.series = paths;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const double speed = std::abs(static_cast<double>(r.speed_rad_per_s[stretches[i].last]));
    if (speed <= r.standstill_rad_per_s) continue;
    panel.series.push_back(KeyPhasor(r, bearing, stretches[i], paths[i].colour));
    if (const auto arrow = Arrow(paths[i], reach)) panel.series.push_back(*arrow);
  }
  return {fmt::format("orbit_enlarged_{}", name),
          fmt::format("The same orbits of {}, enlarged about the centre of the clearance; arrow: "
                      "the way round{}.",
                      name, r.RatioOf(bearing) == 1.0 ? ", dot: the shaft's mark passes" : ""),
          Square(std::move(panel))};
}

}  // namespace

svg::Series Circle(double radius_um, const std::string& name, const std::string& dashes) {
  constexpr int kCorners = 90;
  svg::Series circle = Level(name, 0.0, 0.0, 0.0);
  circle.dashes = dashes;
  circle.x.clear();
  circle.y.clear();
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    circle.x.push_back(radius_um * std::cos(angle));
    circle.y.push_back(radius_um * std::sin(angle));
  }
  return circle;
}

std::vector<NamedPicture> OrbitPictures(const Recording& recording,
                                        const std::vector<double>& speeds_rad_per_s) {
  std::vector<NamedPicture> pictures;
  for (std::size_t b = 0; b < recording.rig.bearings.size(); ++b) {
    std::vector<svg::Series> paths;
    std::vector<Stretch> stretches;
    for (const double speed : speeds_rad_per_s) {
      if (const auto stretch = Nearest(recording, speed)) {
        paths.push_back(Path(recording, b, *stretch, paths.size()));
        stretches.push_back(*stretch);
      }
    }
    if (paths.empty()) continue;
    pictures.push_back(InClearance(recording, b, paths));
    pictures.push_back(Enlarged(recording, b, paths, stretches));
  }
  return pictures;
}

}  // namespace levitas::report
