#pragma once
// The part of a diagnosis' page about its forecast: what the validation records were expected to
// leave, speed by speed, and what was measured.
//
// Picture  residual over speed, a box per band of speed from the low to the high end of its 90 %
//          interval; dots are measured. An open end goes to the picture's edge.
// Units    rpm, um rms over all axes. Thread: any; pure.

#include <string>

#include "diagnosis/report/diagnosis_report.hpp"
#include "diagnosis/report/sentences.hpp"

namespace levitas::report {

/// HTML with its heading; empty where no validation records were given.
[[nodiscard]] std::string ForecastSection(const diagnosis::DiagnosisReport& report,
                                          const diagnosis::ReportSentences& said);

}  // namespace levitas::report
