#include "cli/study/design/schedule_page.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/poles.hpp"
#include "analysis/sensitivity.hpp"
#include "common/rotational_speed.hpp"
#include "report/svg/figure.hpp"
#include "report/text/text_table.hpp"

namespace levitas::cli {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kSlowestHz = 1.0;  // below: integrators, which no one calls a mode

double LeastDamping(const analysis::LoopPoles& loop) {
  double least = 1.0;
  for (const analysis::Pole& pole : loop.poles)
    if (std::abs(pole.frequency_hz) > kSlowestHz) least = std::min(least, pole.damping_ratio);
  return least;
}

std::string Cell(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : std::string("unstable");
}

/// The best of the laws that need no table: stable at every speed, with the least peak.
const LawOverSpeed* BestAlone(const std::vector<LawOverSpeed>& laws) {
  const LawOverSpeed* best = nullptr;
  for (std::size_t i = 0; i + 1 < laws.size(); ++i)
    if (laws[i].stable() && (best == nullptr || laws[i].largest_peak() < best->largest_peak()))
      best = &laws[i];
  return best;
}

std::string WhatItBuys(const std::vector<LawOverSpeed>& laws) {
  constexpr double kLittle = 0.05;
  const LawOverSpeed& table = laws.back();
  const LawOverSpeed* alone = BestAlone(laws);
  if (!table.stable()) return "the schedule does not hold this rig at every speed";
  if (alone == nullptr) {
    return fmt::format(
        "no single law of these holds this rig at every speed; the schedule does, |S| at most "
        "{:.2f}",
        table.largest_peak());
  }
  const double gain = 1.0 - table.largest_peak() / alone->largest_peak();
  return fmt::format("the schedule takes the largest |S| from {:.2f} ({}) to {:.2f}, {:+.0f} %{}",
                     alone->largest_peak(), alone->name, table.largest_peak(),
                     std::abs(gain) < 0.005 ? 0.0 : -100.0 * gain,
                     gain < 0.0       ? ": by |S| one law is better"
                     : gain < kLittle ? ": one law is simpler and as good"
                                      : "");
}

using Values = std::vector<double> LawOverSpeed::*;

svg::Panel PanelOf(const std::vector<LawOverSpeed>& laws, const char* title, const char* label,
                   Values values, double factor) {
  svg::Panel panel{title, "speed [rpm]", label};
  for (std::size_t i = 0; i < laws.size(); ++i) {
    svg::Series series{laws[i].name, laws[i].speed_rpm, laws[i].*values};
    for (double& y : series.y) y *= factor;
    series.colour = svg::Colour(i);
    if (i + 1 < laws.size()) series.dashes = "6 3";
    panel.series.push_back(std::move(series));
  }
  return panel;
}

/// Kp and Kd of each bearing over speed; nothing where one of the laws is a state-space law.
void AddGains(const configuration::RigFile& rig, const law::LawConfig& table, svg::Figure& figure) {
  const bool gains = !table.axes.empty() &&
                     std::ranges::none_of(
                         table.schedule, [](const auto& at) { return at.state_space.has_value(); });
  if (!gains) return;
  svg::Panel kp{"proportional gain", "speed [rpm]", "Kp [A/mm]"};
  svg::Panel kd{"derivative gain", "speed [rpm]", "Kd [A s/m]"};
  for (std::size_t b = 0; b < rig.numbers.bearings.size(); ++b) {
    svg::Series p{rig.numbers.bearings[b]};
    p.colour = svg::Colour(b);
    p.mark = svg::Mark::kDot;
    svg::Series d = p;
    const auto add = [&](double speed_rad_per_s, const std::vector<law::AxisLawConfig>& axes) {
      p.x.push_back(RadPerSToRpm(speed_rad_per_s));
      p.y.push_back(1e-3 * axes[2 * b].kp_a_per_m);
      d.x.push_back(p.x.back());
      d.y.push_back(axes[2 * b].kd_a_s_per_m);
    };
    add(0.0, table.axes);
    for (const law::LawAtSpeed& at : table.schedule) add(at.speed_rad_per_s, at.axes);
    kp.series.push_back(std::move(p));
    kd.series.push_back(std::move(d));
  }
  figure.panels.push_back(std::move(kp));
  figure.panels.push_back(std::move(kd));
}

}  // namespace

bool LawOverSpeed::stable() const {
  return std::ranges::all_of(peak, [](double value) { return std::isfinite(value); });
}

double LawOverSpeed::largest_peak() const { return *std::ranges::max_element(peak); }

std::vector<LawOverSpeed> FiguresOverSpeed(const configuration::RigFile& rig,
                                           const std::vector<NamedLaw>& laws) {
  constexpr int kSteps = 20;
  std::vector<LawOverSpeed> out;
  for (const NamedLaw& named : laws) {
    LawOverSpeed of{named.name, {}, {}, {}, {}};
    for (int i = 0; i <= kSteps; ++i) {
      const double speed = rig.numbers.max_speed_rad_per_s * i / kSteps;
      const auto found = analysis::SensitivityPeaks(rig.plant, named.law, speed);
      double peak = 0.0;
      for (const auto& axis : found.axes) peak = std::max(peak, axis.peak);
      of.speed_rpm.push_back(RadPerSToRpm(speed));
      of.peak.push_back(found.stable ? peak : kNone);
      of.singular.push_back(found.stable ? found.largest_singular_value : kNone);
      of.damping_ratio.push_back(
          found.stable ? LeastDamping(analysis::ClosedLoopPoles(rig.plant, named.law, speed))
                       : kNone);
    }
    out.push_back(std::move(of));
  }
  return out;
}

void PrintOverSpeed(const std::vector<LawOverSpeed>& laws) {
  constexpr std::size_t kEvery = 2;
  report::TextTable table;
  std::vector<std::string> head{"rpm"};
  for (const LawOverSpeed& law : laws) head.push_back("|S| " + law.name);
  for (const LawOverSpeed& law : laws) head.push_back("damping " + law.name);
  table.Add(head);
  for (std::size_t i = 0; i < laws.front().speed_rpm.size(); i += kEvery) {
    std::vector<std::string> cells{fmt::format("{:.0f}", laws.front().speed_rpm[i])};
    for (const LawOverSpeed& law : laws) cells.push_back(Cell(law.peak[i], "{:.2f}"));
    for (const LawOverSpeed& law : laws)
      cells.push_back(Cell(100.0 * law.damping_ratio[i], "{:.2f} %"));
    table.Add(cells);
  }
  fmt::print("{}{}\n", table.Text(), WhatItBuys(laws));
}

nlohmann::ordered_json OverSpeedJson(const std::vector<LawOverSpeed>& laws) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const LawOverSpeed& law : laws) {
    json.push_back({{"name", law.name},
                    {"speed_rpm", law.speed_rpm},
                    {"sensitivity", law.peak},
                    {"singular_value", law.singular},
                    {"least_damping_ratio", law.damping_ratio}});
  }
  return json;
}

std::string SchedulePage(const configuration::RigFile& rig, const std::vector<LawOverSpeed>& laws,
                         const law::LawConfig& table, const design::GateResult& result) {
  svg::Figure figure;
  figure.columns = 2;
  figure.panels.push_back(PanelOf(laws, "|S| of the worst axis", "|S|", &LawOverSpeed::peak, 1.0));
  figure.panels.push_back(PanelOf(laws, "least damping of a mode", "damping ratio [%]",
                                  &LawOverSpeed::damping_ratio, 100.0));
  figure.panels.push_back(
      PanelOf(laws, "largest singular value of S", "sigma(S)", &LawOverSpeed::singular, 1.0));
  AddGains(rig, table, figure);
  return fmt::format(
      "<!doctype html><meta charset=\"utf-8\"><title>Law over speed</title>\n"
      "<style>body{{font-family:sans-serif;margin:2em}}</style>\n<h1>Law over speed: {}</h1>\n"
      "<p>{}. A line ends where its loop is unstable.</p>\n<p>{}</p>\n{}\n",
      rig.numbers.name, WhatItBuys(laws),
      result.accepted ? "Accepted by the check of <code>amb design</code>."
                      : "Not accepted: " + result.reason,
      svg::Draw(figure));
}

}  // namespace levitas::cli
