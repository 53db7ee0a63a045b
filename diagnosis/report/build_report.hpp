#pragma once
// The report of a diagnosis from the result of its search: the one place where parameters,
// calibrated values and sentences are computed for the writers.
//
// Thread   any; pure.
// Failure  std::logic_error for a cause that is not in the catalogue of effects, unless the place
//          is given.

#include <string>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

struct DiagnosisResult;

[[nodiscard]] DiagnosisReport BuildReport(const DiagnosisResult& result);
/// The same with a place that the catalogue of effects does not know.
[[nodiscard]] DiagnosisReport BuildReport(const DiagnosisResult& result, const std::string& place);

}  // namespace levitas::diagnosis
