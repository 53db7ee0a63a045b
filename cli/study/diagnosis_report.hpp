#pragma once
// report.html of a diagnosis: one self-contained page for a person in a hurry.
//
// Order  the sentence; before and after as pictures; the ranking; what was ruled out and why; what
//        to record next. No script, no network.

#include <string>

#include "diagnosis/report/diagnose_files.hpp"

namespace levitas::cli {

/// `more` is put behind the verdict as it is.
[[nodiscard]] std::string DiagnosisPage(const diagnosis::DiagnosisResult& answer,
                                        const std::string& more = {});

}  // namespace levitas::cli
