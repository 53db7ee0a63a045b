#pragma once
// What amb diagnose prints: headline, severity and action, the verdict in detail, the parameters as
// they stand in a rig file, what the calibration has moved, fits, the ranking, what to record next;
// ties and the fits of single records where the report has them; last, which of the rig files does
// not levitate.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/report/diagnosis_report.hpp"
#include "diagnosis/report/sentences.hpp"

namespace levitas::report {

/// `complete`: every calibrated value and every candidate.
void PrintDiagnosis(const diagnosis::DiagnosisReport& report, bool complete);

/// Parameters that are the same at several places, once.
struct SharedParameter {
  diagnosis::NamedParameter parameter;
  std::string places;
  const char* bracket{};  ///< which interval its bracket is
};
[[nodiscard]] std::vector<SharedParameter> SharedParameters(
    const diagnosis::DiagnosisReport& report, const diagnosis::ReportSentences& said);
/// "91.8 to 93.2", of the extended model.
[[nodiscard]] std::string IntervalText(const diagnosis::ReportRunFit& fit);
/// "18.5 at 120.3 deg", or the value alone.
[[nodiscard]] std::string AtPhase(double value, std::optional<double> phase_rad);
/// What to record next; empty hands are said with what they are enough for.
[[nodiscard]] std::string FurtherRecords(const diagnosis::DiagnosisReport& report);
/// With the session that was found for it; empty where none is proposed.
[[nodiscard]] std::string HealthyProposalText(const diagnosis::DiagnosisReport& report);
/// Who makes how much of the rig file's error, the largest first; empty where there is none.
[[nodiscard]] std::string ErrorSharesSentence(const diagnosis::DiagnosisReport& report);
/// Why a fit can lie above its ceiling, or the calibrated rig's below the rig file's; empty where
/// neither does.
[[nodiscard]] std::string FitRemarks(const diagnosis::DiagnosisReport& report);

}  // namespace levitas::report
