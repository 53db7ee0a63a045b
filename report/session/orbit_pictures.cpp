// Orbits at chosen speeds: inside the clearance, and enlarged.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
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
                      const std::vector<svg::Series>& paths) {
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
  return {fmt::format("orbit_enlarged_{}", name),
          fmt::format("The same orbits of {}, enlarged about the centre of the clearance.", name),
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
    for (const double speed : speeds_rad_per_s) {
      if (const auto stretch = Nearest(recording, speed)) {
        paths.push_back(Path(recording, b, *stretch, paths.size()));
      }
    }
    if (paths.empty()) continue;
    pictures.push_back(InClearance(recording, b, paths));
    pictures.push_back(Enlarged(recording, b, paths));
  }
  return pictures;
}

}  // namespace levitas::report
