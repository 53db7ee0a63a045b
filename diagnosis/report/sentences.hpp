#pragma once
// What is said about a report in words, gathered once for whoever lays it out: the terminal and the
// page ask nothing of the diagnosis while they do. Lists said to be per something follow its order
// in the report.
//
// Thread   any; pure. Failure: none.

#include <string>
#include <vector>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

struct ReportSentences {
  std::vector<std::string> record_errors;  ///< one each; empty where the records are in order
  std::string gain;                   ///< what share of what could be gained is gained, and by what
  std::vector<std::string> totals;    ///< of parameters that add to the rig file's own
  std::vector<const char*> brackets;  ///< per parameter: which interval its bracket is
  std::vector<bool> significant;      ///< per calibrated value (report_text.hpp)
  std::string forecast_fit;           ///< interval, see forecast_text.hpp
  struct Band {
    std::string residual_um, fit_percent;
  };
  std::vector<Band> forecast;           ///< per band of speed
  std::vector<std::string> candidates;  ///< per candidate: its name; empty where none is known
  std::vector<std::string> marks;       ///< per mark of the drawn rotor: what stands there
};

[[nodiscard]] ReportSentences SentencesOf(const DiagnosisReport& report);

}  // namespace levitas::diagnosis
