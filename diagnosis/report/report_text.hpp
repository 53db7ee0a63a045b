#pragma once
// Sentences of a report, from its numbers alone.
//
// Order       CompleteReport needs causes, candidates, parameters, calibrated values, fits,
//             coverage and warnings; it writes confidence, reasons and the verdict's sentence.
// Thread      any; pure.

#include <string>
#include <vector>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

/// The next experiment of a diagnosis that leaves nothing open.
inline constexpr const char* kNoneNeeded = "none needed";

/// That of a verdict `none` which is undecided.
inline constexpr const char* kToDecide =
    "the complete answer where this is the first one (--quick), else longer records with a "
    "stronger "
    "test signal, standing and at two speeds";

inline constexpr double kOutside = 3.0;  ///< tolerances from the rig file
/// A verdict `none` that is less likely than this is told as undecided.
inline constexpr double kUndecided = 0.5;

/// Confidence, reasons of the candidates that have none, the verdict's sentence, what is outside
/// its tolerance, and what to do (advice.hpp).
void CompleteReport(DiagnosisReport& report);

/// Calibrated numbers more than kOutside tolerances from the rig file, each with its place.
[[nodiscard]] std::vector<std::string> OutsideTolerance(
    const std::vector<CalibratedValue>& calibrated);
/// Why a cause is suspected and not named; empty for other verdicts.
[[nodiscard]] std::string SuspicionSentence(const DiagnosisReport& report);
[[nodiscard]] std::string VerdictSentence(const DiagnosisReport& report);
/// The experiment that separates tied causes or excites what the records lack; kNoneNeeded when
/// nothing is left open.
[[nodiscard]] std::string SeparatingExperiment(const DiagnosisReport& report);
/// `experiment`, after a check of the input where that is doubted.
[[nodiscard]] std::string NextExperiment(const DiagnosisReport& report,
                                         const std::string& experiment);
/// Probability that the verdict is right: of a cause, among all candidates and none of them; of
/// `none`, against all candidates, each with the prior that a suspected one has (suspicion.hpp); 0
/// for `unknown`, which no effect explains; of `suspected`, that the cause is there.
[[nodiscard]] double Confidence(const DiagnosisReport& report);
/// [nat] of the first cause.
[[nodiscard]] double OwnEvidence(const DiagnosisReport& report);
/// " (4.9 to 5.5, 90 % interval)", or what else it is; empty where there is none.
[[nodiscard]] std::string BracketText(const NamedParameter& parameter);
[[nodiscard]] const char* BracketName(const NamedParameter& parameter);
/// Why a candidate is not the answer; "named" for a cause.
[[nodiscard]] std::string Reason(const DiagnosisReport& report, const ReportCandidate& candidate);
/// One sentence per cause that adds to a value of the rig file: that value, and the two together.
[[nodiscard]] std::vector<std::string> TotalSentences(
    const std::vector<NamedParameter>& parameters);
/// Moved by more than half a tolerance and more than two standard deviations.
[[nodiscard]] bool IsSignificant(const CalibratedValue& value);

}  // namespace levitas::diagnosis
