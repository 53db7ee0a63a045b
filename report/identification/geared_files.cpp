#include "report/identification/geared_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "common/rotational_speed.hpp"
#include "report/svg/figure.hpp"

namespace levitas::cli {
namespace {

using namespace identification;
using Json = nlohmann::ordered_json;

Json ShaftJson(const ShaftFound& s) {
  return {{"ks_n_per_m", s.ks_n_per_m},         {"ks_sigma_n_per_m", s.ks_sigma},
          {"ki_n_per_a", s.ki_n_per_a},         {"ki_sigma_n_per_a", s.ki_sigma},
          {"run_out_m", std::abs(s.run_out_m)}, {"run_out_phase_rad", std::arg(s.run_out_m)},
          {"run_out_sigma_m", s.run_out_sigma}};
}

svg::Panel SpectrumPanel(const std::string& title,
                         const std::map<double, std::vector<const GearedLine*>>& speeds,
                         std::complex<double> GearedLine::*position) {
  svg::Panel panel{.title = title,
                   .x_label = "frequency, Hz (negative: backward)",
                   .y_label = "amplitude, µm",
                   .y_scale = svg::Scale::kLogarithmic};
  std::size_t colour = 0;
  for (const auto& [speed, lines] : speeds) {
    svg::Series series{.name = fmt::format("{:.0f} rpm", RadPerSToRpm(speed)),
                       .colour = svg::Colour(colour++),
                       .width = 0,
                       .mark = svg::Mark::kDot};
    for (const GearedLine* line : lines) {
      series.x.push_back(line->frequency_rad_per_s / (2.0 * std::numbers::pi));
      series.y.push_back(1e6 * std::abs(line->*position));
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

}  // namespace

Json GearedJson(const GearedParameters& p) {
  Json json{{"pinion", ShaftJson(p.pinion)},
            {"gear", ShaftJson(p.gear)},
            {"mesh_stiffness_n_per_m", p.mesh_stiffness_n_per_m},
            {"mesh_stiffness_sigma_n_per_m", p.mesh_stiffness_sigma},
            {"mesh_damping_n_s_per_m", p.mesh_damping_n_s_per_m},
            {"mesh_damping_sigma_n_s_per_m", p.mesh_damping_sigma},
            {"condition", p.condition},
            {"mean_along_line_unknown", p.mean_along_line_unknown}};
  for (const TransmissionError& e : p.error) {
    json["transmission_error"].push_back({{"order", e.harmonic},
                                          {"amplitude_m", std::abs(e.amplitude_m)},
                                          {"phase_rad", std::arg(e.amplitude_m)},
                                          {"sigma_m", e.sigma}});
  }
  return json;
}

void WriteGearedPicture(const std::string& path, const std::vector<GearedLine>& lines) {
  if (path.empty()) return;
  std::map<double, std::vector<const GearedLine*>> speeds;
  for (const GearedLine& line : lines) speeds[line.speed_rad_per_s].push_back(&line);
  svg::Figure figure{.panel_width = 900, .panel_height = 320};
  figure.panels = {SpectrumPanel("pinion", speeds, &GearedLine::pinion_m),
                   SpectrumPanel("gear", speeds, &GearedLine::gear_m)};
  svg::Write(path, figure);
}

}  // namespace levitas::cli
