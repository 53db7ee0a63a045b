#include "diagnosis/report/validation_check.hpp"

#include <fmt/core.h>

#include <cmath>

#include "diagnosis/report/diagnosis_report.hpp"
#include "diagnosis/report/forecast_text.hpp"

namespace levitas::diagnosis {

bool PassesValidation(const DiagnosisReport& s) {
  if (!s.separate_validation) return true;
  const double held = std::sqrt(s.validation.extended_over_noise);
  const double fitted = std::sqrt(s.fitted.extended_over_noise);
  return !(held > kFarAboveNoise && held > kFarAboveNoise * fitted);
}

std::string ValidationSentence(const DiagnosisReport& s) {
  if (PassesValidation(s)) return {};
  const double held = std::sqrt(s.validation.extended_over_noise);
  const double calibrated = std::sqrt(s.validation.calibrated_over_noise);
  std::string text = fmt::format(
      "It does not carry over to the validation data: {:.3g} times the noise (rms) is left there, "
      "{:.3g} times on the fitted data.",
      held, std::sqrt(s.fitted.extended_over_noise));
  if (!s.causes.empty() && held > calibrated) {
    text +=
        fmt::format(" With the cause it is worse there than without ({:.3g} times).", calibrated);
  }
  const std::string forecast = ForecastSentence(s);
  return forecast.empty() ? text : text + " " + forecast;
}

bool IsFaster(double validation_rad_per_s, double fitted_rad_per_s) {
  constexpr double kFaster = 1.1;
  return validation_rad_per_s > kFaster * fitted_rad_per_s + 1.0;
}

std::string ValidationExperiment(const DiagnosisReport& s) {
  return s.validation_is_faster
             ? "a run-up over the speeds of the validation data, among the fitted data"
             : "the same experiment as the validation data once more, among the fitted data";
}

}  // namespace levitas::diagnosis
