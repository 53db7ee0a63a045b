#include "diagnosis/report/forecast_text.hpp"

#include <fmt/core.h>

#include <cmath>

namespace levitas::diagnosis {

std::string RangeText(const ReportForeseen& s, int digits) {
  const bool from = std::isfinite(s.low);
  const bool to = std::isfinite(s.high);
  if (from && to) return fmt::format("{:.{}g} to {:.{}g}", s.low, digits, s.high, digits);
  if (to) return fmt::format("at most {:.{}g}", s.high, digits);
  return from ? fmt::format("at least {:.{}g}", s.low, digits) : "anything";
}

std::string ForecastSentence(const DiagnosisReport& report) {
  if (!report.forecast || report.forecast->by_speed.empty()) return {};
  const ReportForeseen& fit = report.forecast->fit_percent;
  const char* where = fit.covered ? "within" : "above";
  const char* follows =
      "the fitted data leave that much open, and records at those speeds close it";
  if (!fit.covered && fit.measured < fit.low) {
    where = "below";
    follows = "the model lacks something that the fitted data do not show";
  } else if (!fit.covered) {
    follows = "the model is better than its tolerances promise";
  }
  return fmt::format(
      "Its fit of {:.3g} % there is {} the 90 % interval of the forecast ({} %): {}.", fit.measured,
      where, RangeText(fit, 3), follows);
}

}  // namespace levitas::diagnosis
