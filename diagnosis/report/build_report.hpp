#pragma once
// The report of a rotor's diagnosis from the result of its search: the one place where parameters,
// calibrated values, sentences and rig files are computed for whoever reads the report.
//
// Thread   any; pure.
// Failure  std::logic_error for a cause that is not in the catalogue of effects.

#include "configuration/rig_file.hpp"
#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

struct DiagnosisResult;

/// Without the text of the rig files.
[[nodiscard]] DiagnosisReport BuildReport(const DiagnosisResult& result);
/// With the text of the rig files, made from `rig`.
[[nodiscard]] DiagnosisReport BuildReport(const DiagnosisResult& result,
                                          const configuration::RigFile& rig);

}  // namespace levitas::diagnosis
