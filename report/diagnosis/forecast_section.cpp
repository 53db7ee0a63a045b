#include "report/diagnosis/forecast_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/html/table.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report {
namespace {

using diagnosis::ReportForecast;
using diagnosis::ReportForeseen;
using diagnosis::ReportSentences;
using html::Kind;

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

/// From the smallest to the largest residual that is finite and not zero, with some air.
svg::Range Shown(const ReportForecast& forecast) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const ReportForecast::Band& band : forecast.by_speed) {
    const ReportForeseen& r = band.residual_um;
    for (const double value : {r.low, r.high, r.measured}) {
      if (!std::isfinite(value) || value <= 0.0) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  constexpr double kAir = 1.25;
  return high > 0.0 ? svg::Range{low / kAir, high * kAir} : svg::Range{1.0, 10.0};
}

/// The box of one band as a closed line, and a gap behind it.
void AddBox(const ReportForecast::Band& band, const svg::Range& shown, svg::Series& boxes) {
  const auto within = [&shown](double value) {
    return std::isnan(value) ? shown.high : std::clamp(value, shown.low, shown.high);
  };
  const double low = within(band.residual_um.low);
  const double high = within(band.residual_um.high);
  for (const auto& [x, y] :
       {std::pair{band.from_rpm, low}, std::pair{band.to_rpm, low}, std::pair{band.to_rpm, high},
        std::pair{band.from_rpm, high}, std::pair{band.from_rpm, low}, std::pair{kGap, kGap}}) {
    boxes.x.push_back(x);
    boxes.y.push_back(y);
  }
}

std::string Picture(const ReportForecast& forecast) {
  svg::Panel panel;
  panel.title = "Residual of the validation data, expected and measured";
  panel.x_label = "speed, rpm";
  panel.y_label = "residual, µm rms";
  panel.y_scale = svg::Scale::kLogarithmic;
  panel.y_range = Shown(forecast);
  svg::Series boxes{.name = "90 % interval"};
  svg::Series dots{.name = "measured"};
  dots.colour = "#d62728";
  dots.width = 0.0;
  dots.mark = svg::Mark::kDot;
  dots.mark_size = 4.0;
  for (const ReportForecast::Band& band : forecast.by_speed) {
    AddBox(band, *panel.y_range, boxes);
    dots.x.push_back(0.5 * (band.from_rpm + band.to_rpm));
    dots.y.push_back(band.residual_um.measured);
  }
  panel.series = {boxes, dots};
  svg::Figure figure;
  figure.panel_width = 760;
  figure.panels = {panel};
  return svg::Draw(figure);
}

const char* Covered(const ReportForeseen& foreseen) {
  if (foreseen.covered) return "covered";
  return foreseen.measured < foreseen.low ? "below" : "above";
}

std::string Table(const ReportForecast& forecast, const ReportSentences& said) {
  html::Table table({{"rpm", Kind::kNumber},
                     {"residual expected, µm rms", Kind::kNumber},
                     {"measured", Kind::kNumber},
                     {},
                     {"fit expected, %", Kind::kNumber},
                     {"measured", Kind::kNumber}});
  for (std::size_t i = 0; i < said.forecast.size(); ++i) {
    const ReportForecast::Band& band = forecast.by_speed[i];
    table.Add({fmt::format("{:.0f} to {:.0f}", band.from_rpm, band.to_rpm),
               said.forecast[i].residual_um, fmt::format("{:.4g}", band.residual_um.measured),
               Covered(band.residual_um), said.forecast[i].fit_percent,
               fmt::format("{:.1f}", band.fit_percent.measured)});
  }
  return table.Html();
}

}  // namespace

std::string ForecastSection(const diagnosis::DiagnosisReport& s, const ReportSentences& said) {
  if (!s.forecast || s.forecast->by_speed.empty()) return {};
  const ReportForeseen& fit = s.forecast->fit_percent;
  return fmt::format(
      "<h2>Forecast of the validation data</h2>\n<p>Of 100 rigs that the fitted data cannot tell "
      "from this one, 90 would leave a residual within the interval. Fit of stretches of the "
      "validation data: expected {} %, measured {:.1f} %: {}. Chance to beat the rig file, before "
      "the validation data were seen: {:.0f} %.</p>\n{}{}",
      said.forecast_fit, fit.measured, Covered(fit), 100.0 * s.forecast->better_than_file,
      Picture(*s.forecast), Table(*s.forecast, said));
}

}  // namespace levitas::report
