#pragma once
// What amb diagnose writes: diagnosis.json, extended_rig.yaml, calibrated_rig.yaml, report.html.
//
// Failure  BadInput when a file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::report {

[[nodiscard]] nlohmann::ordered_json DiagnosisJson(const diagnosis::DiagnosisReport& report);
/// Its `forecast`; what is not finite is null.
[[nodiscard]] nlohmann::ordered_json ForecastJson(const diagnosis::ReportForecast& forecast);
/// The paths that were written.
std::vector<std::string> WriteDiagnosis(const diagnosis::DiagnosisReport& report,
                                        const std::string& folder);

}  // namespace levitas::report
