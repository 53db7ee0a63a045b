// Pictures of a comparison of recorded runs: orbits side by side, amplitudes over speed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/rotational_speed.hpp"
#include "report/session/comparison_page.hpp"

namespace levitas::report {
namespace {

constexpr double kOrbitWidth = 300;   // 74 of it beside the drawing area
constexpr double kOrbitHeight = 307;  // 81 of it above and below, with the line of the legend
constexpr double kRoom = 1.1;         // about the largest orbit or circle

/// Half the side of every panel: the orbits of all records and speeds fit, the circle too.
double ReachUm(const Comparison& c, double circle_um) {
  double reach = std::max(1.0, circle_um);
  for (const ComparedRecord& record : c.records) {
    for (const auto& at : record.speeds) {
      if (!at) continue;
      for (const double radius_m : at->found.largest_radius_m) {
        reach = std::max(reach, kUm * radius_m);
      }
    }
  }
  return kRoom * reach;
}

svg::Series OrbitSeries(const Orbit& orbit, std::size_t number) {
  svg::Series series;
  series.colour = svg::Colour(number);
  for (const double x_m : orbit.x_m) series.x.push_back(kUm * x_m);
  for (const double y_m : orbit.y_m) series.y.push_back(kUm * y_m);
  return series;
}

NamedPicture OrbitsOf(const Comparison& c, std::size_t bearing, double circle_um, double reach_um) {
  svg::Figure figure;
  figure.columns = c.speeds_rad_per_s.size();
  figure.panel_width = kOrbitWidth;
  figure.panel_height = kOrbitHeight;
  std::vector<bool> named(c.records.size());  // once is enough: a legend needs room
  for (std::size_t i = 0; i < c.speeds_rad_per_s.size(); ++i) {
    svg::Panel panel{
        fmt::format("{}, {:.0f} rpm", c.bearings[bearing], RadPerSToRpm(c.speeds_rad_per_s[i])),
        "x, µm", "y, µm"};
    panel.x_range = panel.y_range = svg::Range{-reach_um, reach_um};
    panel.same_scale = true;
    if (circle_um > 0.0) {
      panel.series.push_back(Circle(circle_um, "", "6 3"));
      panel.series.back().colour = "#c00000";
    }
    for (std::size_t n = 0; n < c.records.size(); ++n) {
      const auto& at = c.records[n].speeds[i];
      if (!at) continue;
      panel.series.push_back(OrbitSeries(at->orbits[bearing], n));
      if (!named[n]) panel.series.back().name = c.records[n].label;
      named[n] = true;
    }
    figure.panels.push_back(std::move(panel));
  }
  std::string caption =
      fmt::format("Orbits at the sensors of {}, two turns at each speed, all on one scale",
                  c.bearings[bearing]);
  caption += circle_um > 0.0
                 ? fmt::format("; dashed: the objective, a circle of {:g} µm.", circle_um)
                 : ".";
  return {"orbits_" + c.bearings[bearing], std::move(caption), std::move(figure)};
}

using Axes = std::vector<analysis::OrderAmplitudes> analysis::SynchronousRows::*;

svg::Series AmplitudeCurve(const Comparison& c, std::size_t record, std::size_t order,
                           std::size_t axis, Axes axes, double unit) {
  static constexpr const char* kDashes[] = {"", "6 3", "2 3", "8 3 2 3"};
  svg::Series series;
  series.colour = svg::Colour(record);
  series.dashes = kDashes[order % std::size(kDashes)];
  for (const analysis::SynchronousRows& at : c.records[record].over_speed) {
    series.x.push_back(RadPerSToRpm(at.speed_rad_per_s));
    series.y.push_back(unit * (at.*axes)[axis].amplitude[order]);
  }
  return series;
}

/// "; solid 1x, dashed 3x"
std::string LinesOf(const std::vector<double>& orders) {
  static constexpr const char* kNames[] = {"solid", "dashed", "dotted", "dash-dotted"};
  std::string text;
  for (std::size_t k = 0; k < orders.size(); ++k) {
    text +=
        fmt::format("{} {} {:g}x", k == 0 ? ";" : ",", kNames[k % std::size(kNames)], orders[k]);
  }
  return text;
}

/// Amplitudes of one kind over speed, a panel per axis.
NamedPicture OverSpeed(const Comparison& c, Axes axes, const std::string& name,
                       const std::string& of, const std::string& label, double unit) {
  svg::Figure figure;
  figure.columns = 2;
  for (std::size_t axis = 0; axis < c.channels.size(); ++axis) {
    svg::Panel panel{c.channels[axis], "speed, rpm", label};
    for (std::size_t n = 0; n < c.records.size(); ++n) {
      for (std::size_t k = 0; k < c.orders.size(); ++k) {
        panel.series.push_back(AmplitudeCurve(c, n, k, axis, axes, unit));
        if (axis == 0 && k == 0) panel.series.back().name = c.records[n].label;
      }
    }
    figure.panels.push_back(std::move(panel));
  }
  return {name,
          fmt::format("Synchronous amplitude of the {} of each axis over speed, where the records "
                      "turn without a test signal{}.",
                      of, LinesOf(c.orders)),
          std::move(figure)};
}

}  // namespace

std::vector<NamedPicture> ComparisonPictures(const Comparison& comparison, double circle_um) {
  std::vector<NamedPicture> pictures;
  const double reach_um = ReachUm(comparison, circle_um);
  for (std::size_t b = 0; b < comparison.bearings.size(); ++b) {
    pictures.push_back(OrbitsOf(comparison, b, circle_um, reach_um));
  }
  const bool turns = std::any_of(comparison.records.begin(), comparison.records.end(),
                                 [](const auto& record) { return !record.over_speed.empty(); });
  if (!turns) return pictures;
  pictures.push_back(OverSpeed(comparison, &analysis::SynchronousRows::position_m,
                               "position_over_speed", "position", "µm", kUm));
  pictures.push_back(OverSpeed(comparison, &analysis::SynchronousRows::current_a,
                               "current_over_speed", "control current", "A", 1.0));
  return pictures;
}

}  // namespace levitas::report
