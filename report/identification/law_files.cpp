#include "report/identification/law_files.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/svg/figure.hpp"

namespace levitas::report {
namespace {

using identification::LawFit;

double Degrees(std::complex<double> value) { return std::arg(value) * 180.0 / std::numbers::pi; }

svg::Panel BodePanel(const LawFit& fit, bool phase) {
  svg::Series measured{.name = "measured",
                       .colour = "#999999",
                       .width = 0,
                       .mark = svg::Mark::kDot,
                       .mark_size = 1.5};
  svg::Series found{.name = "order " + std::to_string(fit.law.order()), .colour = svg::Colour(0)};
  for (std::size_t i = 0; i < fit.measured.size(); ++i) {
    const std::complex<double> value = fit.At(fit.measured_hz[i]);
    for (auto* series : {&measured, &found}) series->x.push_back(fit.measured_hz[i]);
    measured.y.push_back(phase ? Degrees(fit.measured[i]) : std::abs(fit.measured[i]));
    found.y.push_back(phase ? Degrees(value) : std::abs(value));
  }
  svg::Panel panel{.title = fit.name,
                   .x_label = "frequency, Hz",
                   .y_label = phase ? "phase, degrees" : "output per input",
                   .x_scale = svg::Scale::kLogarithmic,
                   .y_scale = phase ? svg::Scale::kLinear : svg::Scale::kLogarithmic};
  panel.series = {std::move(measured), std::move(found)};
  return panel;
}

}  // namespace

nlohmann::ordered_json LawJson(const std::vector<LawFit>& fits) {
  nlohmann::ordered_json json;
  for (const LawFit& fit : fits) {
    nlohmann::ordered_json one{
        {"name", fit.name},
        {"discrete", fit.options.domain == identification::LawDomain::kDiscrete},
        {"order", fit.law.order()},
        {"fit_percent", fit.fit_percent},
        {"lines", fit.lines},
        {"lowest_hz", fit.options.lowest_hz},
        {"highest_hz", fit.options.highest_hz},
        {"direct", fit.law.direct}};
    for (const identification::Pole& pole : fit.law.poles) {
      one["poles"].push_back({{"real", pole.place.real()},
                              {"imaginary", pole.place.imag()},
                              {"residue_real", pole.residue.real()},
                              {"residue_imaginary", pole.residue.imag()}});
    }
    for (const identification::OrderTried& tried : fit.tried)
      one["orders_tried"].push_back({{"order", tried.order}, {"fit_percent", tried.fit_percent}});
    json["controllers"].push_back(std::move(one));
  }
  return json;
}

void WriteLawPicture(const std::string& path, const std::vector<LawFit>& fits) {
  if (path.empty()) return;
  svg::Figure figure{.columns = fits.size(), .panel_width = 420, .panel_height = 260};
  for (const bool phase : {false, true})
    for (const LawFit& fit : fits) figure.panels.push_back(BodePanel(fit, phase));
  svg::Write(path, figure);
}

}  // namespace levitas::report
