#include "cli/study/design/pid_page.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>

#include "common/rotational_speed.hpp"
#include "report/html/table.hpp"
#include "report/svg/figure.hpp"

namespace levitas::cli {
namespace {

struct Band {
  const char* name;
  double below;
  const char* colour;
};
/// Zones of ISO 14839-3; colours from dark to light, so that they print in grey too.
constexpr std::array<Band, 4> kBands{{{"|S| < 3", 3.0, "#08519c"},
                                      {"< 4", 4.0, "#3182bd"},
                                      {"< 5", 5.0, "#6baed6"},
                                      {"more", HUGE_VAL, "#c6dbef"}}};

svg::Panel MapPanel(const NamedLaw& named, const design::GainMap& map) {
  svg::Panel panel{named.name, "Kp over the law's", "Kd over the law's", svg::Scale::kLogarithmic,
                   svg::Scale::kLogarithmic};
  const std::size_t n = map.factors.size();
  double above = 0.0;
  for (const Band& band : kBands) {
    svg::Series series{band.name};
    series.colour = band.colour;
    series.width = 0.0;
    series.mark = svg::Mark::kDot;
    series.mark_size = 5.5;
    for (std::size_t i = 0; i < map.peak.size(); ++i) {
      if (!std::isfinite(map.peak[i]) || map.peak[i] < above || map.peak[i] >= band.below) continue;
      series.x.push_back(map.factors[i % n]);
      series.y.push_back(map.factors[i / n]);
    }
    above = band.below;
    panel.series.push_back(std::move(series));
  }
  svg::Series here{"law", {1.0}, {1.0}, "#d62728", 0.0, "", svg::Mark::kCross, 6.0};
  panel.series.push_back(std::move(here));
  panel.x_range = svg::Range{map.factors.front() / 1.1, map.factors.back() * 1.1};
  panel.y_range = panel.x_range;
  return panel;
}

std::string Table(const design::PidFigures& figures, const design::PidLimits& limits) {
  html::Table table({{"requirement"}, {"limit"}, {"reached"}, {"at"}});
  for (std::size_t i = 0; i < design::kLimits; ++i) {
    const auto limit = static_cast<design::Limit>(i);
    const auto& met = figures[limit];
    table.Add({std::string(design::NameOf(limit)),
               limits[limit] ? design::ValueText(limit, *limits[limit]) : "-",
               design::ValueText(limit, met.found),
               fmt::format("{}{:.0f} rpm", met.hz > 0.0 ? fmt::format("{:.1f} Hz, ", met.hz) : "",
                           RadPerSToRpm(met.speed_rad_per_s))});
  }
  return table.Html();
}

}  // namespace

std::string PidPage(const configuration::RigFile& rig, const std::vector<NamedLaw>& laws,
                    const design::PidFigures& figures, const design::PidLimits& limits) {
  const auto plants = [&](const design::Coordinates& coordinates) {
    std::vector<std::shared_ptr<const design::SampledPlant>> out;
    for (const double share : {0.0, 1.0})
      if (share == 0.0 || rig.numbers.axes() > 1)
        out.push_back(std::make_shared<design::SampledPlant>(
            rig, share * rig.numbers.max_speed_rad_per_s, design::Known::kAll, coordinates));
    return out;
  };
  svg::Figure figure;
  figure.columns = 2;
  figure.panel_width = 440;
  figure.panel_height = 400;
  for (const NamedLaw& named : laws) {
    if (named.law.axes.empty() || !named.law.schedule.empty()) continue;  // no one set of gains
    figure.panels.push_back(
        MapPanel(named, design::MapGains(named.law, plants(named.coordinates), {})));
  }
  return fmt::format(
      "<!doctype html><meta charset=\"utf-8\"><title>PID design</title>\n"
      "<style>body{{font-family:sans-serif;margin:2em}}td,th{{padding:2px 12px;text-align:left}}"
      "</style>\n<h1>PID design: {}</h1>\n{}"
      "<h2>Gains that hold the rig</h2>\n<p>Kp (with Ki) and Kd of every axis (or of translation "
      "and tilt) times a factor, the "
      "filters unchanged; at rest and at the rated speed. Where nothing is drawn a loop is "
      "unstable. |S| below 3, 4, 5: zones A, B, C of ISO 14839-3.</p>\n{}\n",
      rig.numbers.name, Table(figures, limits), svg::Draw(figure));
}

}  // namespace levitas::cli
