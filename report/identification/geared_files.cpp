#include "report/identification/geared_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report {
namespace {

using namespace identification;
using Json = nlohmann::ordered_json;

Json ShaftJson(const ShaftFound& s) {
  Json json{{"ks_n_per_m", s.ks_n_per_m},         {"ks_sigma_n_per_m", s.ks_sigma},
            {"ki_n_per_a", s.ki_n_per_a},         {"ki_sigma_n_per_a", s.ki_sigma},
            {"run_out_m", std::abs(s.run_out_m)}, {"run_out_phase_rad", std::arg(s.run_out_m)},
            {"run_out_sigma_m", s.run_out_sigma}};
  if (!s.plane) return json;
  json["probe_plane"] = {
      {"probe_z_m", s.plane->probe_z_m},
      {"gear_z_m", s.plane->gear_z_m},
      {"median", {{"ratio", s.plane->median_amplification}}},
      {"largest", {{"ratio", s.plane->amplification}, {"at_hz", s.plane->at_rad_per_s / kTwoPi}}},
      {"lines_left_out", {{"count", s.plane->left_out}}}};
  return json;
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
      series.x.push_back(line->frequency_rad_per_s / kTwoPi);
      series.y.push_back(1e6 * std::abs(line->*position));
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

/// Measured torque as dots, the identified model's as a line.
svg::Panel TorsionPanel(const HalfSpectrum& half, std::size_t coupling) {
  svg::Panel panel{.title = "torque, " + half.couplings[coupling].name + ": measured and model",
                   .x_label = "frequency, Hz",
                   .y_label = "amplitude, N m",
                   .y_scale = svg::Scale::kLogarithmic};
  std::map<double, std::vector<const TorsionLine*>> speeds;
  for (const TorsionLine& line : half.lines) {
    if (line.coupling == coupling) speeds[line.speed_rad_per_s].push_back(&line);
  }
  std::size_t colour = 0;
  for (auto& [speed, lines] : speeds) {
    std::ranges::sort(lines, {}, &TorsionLine::frequency_rad_per_s);
    svg::Series measured{.name = fmt::format("{:.0f} rpm", RadPerSToRpm(speed)),
                         .colour = svg::Colour(colour++),
                         .width = 0,
                         .mark = svg::Mark::kDot};
    svg::Series model{.name = "model", .colour = measured.colour, .width = 0.9};
    for (const TorsionLine* line : lines) {
      measured.x.push_back(line->frequency_rad_per_s / kTwoPi);
      measured.y.push_back(std::abs(line->torque_n_m));
      if (!line->model_n_m) continue;
      model.x.push_back(measured.x.back());
      model.y.push_back(std::abs(*line->model_n_m));
    }
    panel.series.push_back(std::move(measured));
    panel.series.push_back(std::move(model));
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

std::string ProbePlaneText(const std::string& shaft, const ProbePlane& plane) {
  return fmt::format(
      "{:<7} probes {:.6g} mm from the gear (z {:.6g} and {:.6g} mm): it moves {:.3g} times as "
      "far as they do, {:.3g} times at {:.0f} Hz;\n    {} line(s) left out near nodes\n",
      shaft, 1e3 * std::abs(plane.probe_z_m - plane.gear_z_m), 1e3 * plane.probe_z_m,
      1e3 * plane.gear_z_m, plane.median_amplification, plane.amplification,
      plane.at_rad_per_s / kTwoPi, plane.left_out);
}

Json TorsionJson(const HalfSpectrum& half) {
  Json couplings = Json::array();
  for (std::size_t c = 0; c < half.couplings.size(); ++c) {
    const CouplingFound& at = half.couplings[c];
    Json lines = Json::array();
    for (const TorsionLine& line : half.lines) {
      if (line.coupling != c) continue;
      lines.push_back(
          {{"line", line.name},
           {"pinion_speed_hz", line.speed_rad_per_s / kTwoPi},
           {"frequency_hz", line.frequency_rad_per_s / kTwoPi},
           {"torque_n_m", std::abs(line.torque_n_m)},
           {"torque_phase_rad", std::arg(line.torque_n_m)},
           {"torque_sigma_n_m", line.torque_sigma_n_m},
           {"twist_rad", std::abs(line.twist_rad)},
           {"twist_sigma_rad", line.twist_sigma_rad},
           {"model_torque_n_m", line.model_n_m ? Json(std::abs(*line.model_n_m)) : Json(nullptr)},
           {"model_phase_rad", line.model_n_m ? Json(std::arg(*line.model_n_m)) : Json(nullptr)}});
    }
    const bool found = at.lines_used > 0;
    couplings.push_back(
        {{"coupling", at.name},
         {"stiffness_n_m_per_rad", found ? Json(at.stiffness_n_m_per_rad) : Json(nullptr)},
         {"stiffness_sigma_n_m_per_rad", found ? Json(at.stiffness_sigma) : Json(nullptr)},
         {"known_n_m_per_rad", at.known_n_m_per_rad},
         {"unexplained_share", at.unexplained_share ? Json(*at.unexplained_share) : Json(nullptr)},
         {"lines", lines}});
  }
  return couplings;
}

void WriteGearedPicture(const std::string& path, const std::vector<GearedLine>& lines,
                        const HalfSpectrum& half) {
  if (path.empty()) return;
  std::map<double, std::vector<const GearedLine*>> speeds;
  for (const GearedLine& line : lines) speeds[line.speed_rad_per_s].push_back(&line);
  svg::Figure figure{.panel_width = 900, .panel_height = 320};
  figure.panels = {SpectrumPanel("pinion", speeds, &GearedLine::pinion_m),
                   SpectrumPanel("gear", speeds, &GearedLine::gear_m)};
  for (std::size_t c = 0; c < half.couplings.size(); ++c) {
    figure.panels.push_back(TorsionPanel(half, c));
  }
  svg::Write(path, figure);
}

}  // namespace levitas::report
