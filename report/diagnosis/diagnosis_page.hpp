#pragma once
// report.html of a diagnosis: one self-contained page for a person in a hurry.
//
// Order  the sentence; before and after as pictures; the forecast of validation records; the
//        ranking; what was ruled out and why; what to record next; fits of single records where the
//        report has them. No script, no network.

#include <string>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::report {

[[nodiscard]] std::string DiagnosisPage(const diagnosis::DiagnosisReport& report);

}  // namespace levitas::report
