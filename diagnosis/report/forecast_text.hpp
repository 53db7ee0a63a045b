#pragma once
// Words for the interval of a forecast.
//
// Interval   of 90 of 100 rigs that the fitted data cannot tell from this one
//            (inference/forecast_interval.hpp). Draws that diverge leave an end open.
// Fit        that of stretches of the validation data; of the whole it may differ.
// Thread     any; pure.

#include <string>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

/// "1.2 to 3.4", "at most 3.4" or "at least 1.2" where an end is open, "anything" where both are.
/// `digits`: significant ones.
[[nodiscard]] std::string RangeText(const ReportForeseen& foreseen, int digits);
/// Whether the measured fit lies in the interval, and what follows; empty without a forecast.
[[nodiscard]] std::string ForecastSentence(const DiagnosisReport& report);

}  // namespace levitas::diagnosis
