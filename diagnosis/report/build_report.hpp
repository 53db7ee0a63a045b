#pragma once
// The report of a diagnosis from the result of its search: the one place where parameters,
// calibrated values and sentences are computed for the writers.
//
// Thread   any; pure.
// Failure  none for the result of DiagnoseFiles, DiagnoseRecords or levitator::Diagnose.

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

struct DiagnosisResult;

[[nodiscard]] DiagnosisReport BuildReport(const DiagnosisResult& result);

}  // namespace levitas::diagnosis
