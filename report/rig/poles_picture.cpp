#include "report/rig/poles_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/rotational_speed.hpp"
#include "report/rig/campbell_panel.hpp"

namespace levitas::report {
namespace {

using analysis::LoopPoles;
using analysis::Pole;
constexpr double kFarLeftDamping = 0.45;
constexpr const char* kGrows = "#fbdcc8";

/// 0 forward, 1 backward, 2 neither.
std::size_t Direction(const Pole& pole, bool turning) {
  if (!turning || pole.frequency_hz == 0.0) return 2;
  const analysis::CampbellMode mode{.forward_share = pole.forward_share};
  const std::string_view name = analysis::WhirlName(mode);
  return name == "forward" ? 0 : name == "backward" ? 1 : 2;
}

/// The poles of one speed in three series, by direction.
std::array<svg::Series, 3> PolesOf(const LoopPoles& at, std::size_t number, double up_to_hz,
                                   double (*x)(const Pole&), double (*y)(const Pole&)) {
  constexpr std::array kNames{"forward", "backward", ""};
  constexpr std::array kMarks{svg::Mark::kUp, svg::Mark::kDown, svg::Mark::kRing};
  std::array<svg::Series, 3> series;
  const bool turning = at.speed_rad_per_s != 0.0;
  for (const Pole& pole : at.poles) {
    if (std::abs(pole.frequency_hz) > up_to_hz) continue;
    svg::Series& to = series[Direction(pole, turning)];
    to.x.push_back(x(pole));
    to.y.push_back(y(pole));
  }
  for (std::size_t i = 0; i < series.size(); ++i) {
    const bool named = !series[i].x.empty() && (i < 2 || !turning);
    if (named) {
      series[i].name = fmt::format("{:.0f} rpm {}", RadPerSToRpm(at.speed_rad_per_s), kNames[i]);
    }
    series[i].colour = svg::Colour(number);
    series[i].width = 0.0;
    series[i].mark = kMarks[i];
    series[i].mark_size = 4.0;
  }
  return series;
}

/// Real parts drawn: every pole that grows, and those that are not damped far to the left.
svg::Range RealParts(const std::vector<LoopPoles>& loops, double up_to_hz) {
  svg::Range range{-1.0, 0.0};
  for (const LoopPoles& at : loops) {
    for (const Pole& pole : at.poles) {
      if (std::abs(pole.frequency_hz) > up_to_hz || pole.damping_ratio > kFarLeftDamping) continue;
      range.low = std::min(range.low, 1.1 * pole.s_rad_per_s.real());
      range.high = std::max(range.high, 1.2 * pole.s_rad_per_s.real());
    }
  }
  return {range.low, std::max(range.high, -0.08 * range.low)};
}

/// Lines of equal damping ratio.
void AddRays(double up_to_hz, svg::Panel& panel) {
  const double apart = 0.07 * (panel.x_range->high - panel.x_range->low);
  double last = 0.0;
  double last_hz = -up_to_hz;
  for (const double damping : {0.4, 0.2, 0.1, 0.05, 0.02}) {
    const double per_hz = -2.0 * std::numbers::pi * damping / std::sqrt(1.0 - damping * damping);
    const double end_hz = std::min(up_to_hz, panel.x_range->low / per_hz);
    panel.series.push_back({.x = {0.0, per_hz * end_hz},
                            .y = {0.0, end_hz},
                            .colour = "#999999",
                            .width = 0.8,
                            .dashes = "4 3"});
    const double at_hz = 0.95 * end_hz;
    const double at = per_hz * at_hz;
    const bool meets = std::abs(at - last) < apart && at_hz - last_hz < 0.06 * up_to_hz;
    if (meets || -at < 0.5 * apart) continue;  // its number would be crossed by another
    last = at;
    last_hz = at_hz;
    panel.notes.push_back({.x = at,
                           .y = at_hz,
                           .text = fmt::format("{:g}", damping),
                           .anchor = svg::Anchor::kMiddle,
                           .colour = "#666666"});
  }
}

/// What the picture leaves out, so that nobody takes its poles for all: of the speed with most.
std::string LeftOut(const std::vector<LoopPoles>& loops, double up_to_hz, double left_rad_per_s) {
  std::ptrdiff_t beyond = 0, left = 0;
  for (const LoopPoles& loop : loops) {
    const auto is_beyond = [&](const Pole& pole) { return std::abs(pole.frequency_hz) > up_to_hz; };
    beyond = std::max(beyond, std::ranges::count_if(loop.poles, is_beyond));
    left = std::max(left, std::ranges::count_if(loop.poles, [&](const Pole& pole) {
                      return !is_beyond(pole) && pole.s_rad_per_s.real() < left_rad_per_s;
                    }));
  }
  return (beyond == 0 ? "" : fmt::format(", {} beyond", beyond)) +
         (left == 0 ? "" : fmt::format(", {} further left", left));
}

svg::Panel PlanePanel(const std::vector<LoopPoles>& loops, double up_to_hz) {
  svg::Panel panel{.x_label = "Re s, 1/s", .y_label = "frequency, Hz"};
  panel.x_range = RealParts(loops, up_to_hz);
  panel.title = fmt::format("Poles to {:g} Hz{}; dashed: equal damping ratio", up_to_hz,
                            LeftOut(loops, up_to_hz, panel.x_range->low));
  panel.y_range = svg::Range{-0.02 * up_to_hz, up_to_hz};
  const double right = panel.x_range->high;
  panel.series.push_back({.x = {0.0, right, right, 0.0},
                          .y = {-up_to_hz, -up_to_hz, up_to_hz, up_to_hz},
                          .width = 0.0,
                          .fill = kGrows});
  panel.series.push_back(
      {.x = {0.0, 0.0}, .y = {-up_to_hz, up_to_hz}, .colour = "#000000", .width = 1.0});
  panel.notes.push_back({.x = right,
                         .y = up_to_hz,
                         .text = "grows",
                         .anchor = svg::Anchor::kEnd,
                         .right_px = -3,
                         .down_px = 24,
                         .colour = "#7a3b12"});
  AddRays(up_to_hz, panel);
  const auto x = [](const Pole& pole) { return pole.s_rad_per_s.real(); };
  const auto y = [](const Pole& pole) { return std::abs(pole.frequency_hz); };
  for (std::size_t i = 0; i < loops.size(); ++i) {
    for (auto& series : PolesOf(loops[i], i, up_to_hz, x, y)) panel.series.push_back(series);
  }
  return panel;
}

svg::Panel DampingOverFrequency(const std::vector<LoopPoles>& loops, double up_to_hz) {
  svg::Panel panel{.title = "Damping of the same poles",
                   .x_label = "frequency, Hz",
                   .y_label = "damping ratio",
                   .x_scale = svg::Scale::kLogarithmic,
                   .y_scale = svg::Scale::kLogarithmic};
  panel.x_range = svg::Range{1.0, up_to_hz};
  panel.y_range = svg::Range{1e-4, 1.2};
  const auto x = [](const Pole& pole) { return std::abs(pole.frequency_hz); };
  const auto y = [](const Pole& pole) { return pole.damping_ratio; };
  std::size_t growing = 0;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    for (auto& series : PolesOf(loops[i], i, up_to_hz, x, y)) {
      series.name.clear();
      panel.series.push_back(series);
    }
    for (const Pole& pole : loops[i].poles) {
      if (analysis::Grows(pole)) ++growing;
    }
  }
  if (growing > 0) {
    panel.notes.push_back({.x = 1.0,
                           .y = 1e-4,
                           .text = fmt::format("{} that grow have no place here", growing),
                           .right_px = 6,
                           .down_px = -10,
                           .colour = "#b0300c"});
  }
  return panel;
}

}  // namespace

svg::Panel LevitatedPanel(const analysis::Campbell& levitated, double rated_rad_per_s) {
  constexpr double kTimesRotation = 1.5;
  constexpr std::size_t kAtLeast = 6;  // modes at rest: the rigid ones and a bending one
  double top = kTimesRotation * levitated.speeds.back().speed_rad_per_s / (2.0 * std::numbers::pi);
  std::vector<double> standing;
  for (const auto& mode : levitated.speeds.front().modes) standing.push_back(mode.frequency_hz);
  std::sort(standing.begin(), standing.end());
  if (!standing.empty()) {
    top = std::max(top, 1.2 * standing[std::min(kAtLeast, standing.size()) - 1]);
  }
  return CampbellPanel(levitated, {"Campbell diagram, levitated", rated_rad_per_s, top});
}

svg::Figure PolesPicture(const std::vector<LoopPoles>& loops, const analysis::Campbell& levitated,
                         const PolesLook& look) {
  svg::Figure figure{.title = look.title, .columns = 2, .panel_width = 460, .panel_height = 380};
  figure.lines.push_back(
      "Sampled loop, delay included; over speed the modes with a damping ratio below 0.71, which "
      "resonate, and where rotation meets them: critical speeds");
  figure.panels = {PlanePanel(loops, look.up_to_hz), DampingOverFrequency(loops, look.up_to_hz),
                   LevitatedPanel(levitated, look.rated_rad_per_s),
                   DampingPanel(levitated, {"Damping over speed", look.rated_rad_per_s, 0.0})};
  return figure;
}

}  // namespace levitas::report
