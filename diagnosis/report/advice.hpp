#pragma once
// The answer for who acts on it: headline, severity and action, in words of the workshop
// (plant_sim/effect/workshop.hpp). From the report's numbers alone.
//
// Certainty  of the confidence: from 0.99 nearly certain, from 0.9 very likely, from 0.5 likely,
//            else one of several that are possible.
// Odds       e^nat as a power of ten, rounded down.
// Coherent   what is said follows from one set of conditions: nothing is called in order beside a
//            cause, a candidate that may well be there, or a number that is measurably off.
// Thread     any; pure.

#include <string>
#include <vector>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

/// Standard deviations from what was expected: so far off is no scatter of the data.
inline constexpr double kMeasurablyOff = 5.0;

/// Headline, certainty, severity, action and the proposal of healthy records.
void Advise(DiagnosisReport& report);

/// Those of the report first, then the workshop's; null for neither.
[[nodiscard]] const effect::Words* FindWords(const DiagnosisReport& report,
                                             const std::string& effect);
/// "Crack in the shaft near z = 241 mm, 30 % of the diameter deep".
[[nodiscard]] std::string InWords(const DiagnosisReport& report, const ReportCause& cause);
/// "10^8 : 1".
[[nodiscard]] std::string OddsText(double nat);
/// "93 %", never all and never nothing.
[[nodiscard]] std::string PercentText(double share);
[[nodiscard]] std::string CertaintyText(double confidence);
/// Calibrated values more than kMeasurablyOff standard deviations away, the furthest first.
[[nodiscard]] std::vector<CalibratedValue> MeasurablyOff(const DiagnosisReport& report);
/// Verdict none, nothing undecided, nothing measurably off, no doubt of the input.
[[nodiscard]] bool AllInOrder(const DiagnosisReport& report);
[[nodiscard]] const char* Name(Severity severity);

}  // namespace levitas::diagnosis
