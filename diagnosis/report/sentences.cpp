#include "diagnosis/report/sentences.hpp"

#include <fmt/core.h>

#include <cmath>

#include "diagnosis/report/advice.hpp"
#include "diagnosis/report/forecast_text.hpp"
#include "diagnosis/report/report_text.hpp"

namespace levitas::diagnosis {
namespace {

std::string SmallErrorSentence(const DiagnosisReport& s) {
  if (AllInOrder(s)) {
    return "Nothing to gain: the rig file itself predicts these data nearly to their noise.";
  }
  const std::string text =
      "One step ahead the rig file itself predicts the validation data nearly to their noise, so "
      "the fit says little here; ";
  if (!s.causes.empty()) {
    return text + fmt::format("the evidence of {:.0f} nat decides.", OwnEvidence(s));
  }
  return text + (s.verdict == Verdict::kUnknown
                     ? "what is left stands out in few lines of the spectrum."
                     : "the numbers that are off, and the candidates, do.");
}

std::string GainSentence(const DiagnosisReport& s) {
  const ReportFit& validation = s.validation;
  if (!validation.meaningful) return SmallErrorSentence(s);
  const std::string gained = fmt::format(
      "On validation data this model reaches {:.1f} % ({:.1f} to {:.1f} %) of the achievable gain",
      100.0 * validation.achieved.fraction, 100.0 * validation.achieved.low,
      100.0 * validation.achieved.high);
  if (s.causes.empty()) return gained + ", by calibration.";
  if (validation.calibration_is_complete) {
    return fmt::format(
        "{}; so does calibration alone, which leaves hardly more than the noise: the cause is "
        "decided by its evidence of {:.0f} nat.",
        gained, OwnEvidence(s));
  }
  const double beyond = 100.0 * validation.beyond_calibration;
  return std::lround(beyond) < 0
             ? fmt::format("{}; the cause adds {:.0f} % to what calibration leaves.", gained,
                           -beyond)
             : fmt::format("{}; of what calibration leaves, the cause takes {:.0f} %.", gained,
                           std::abs(beyond));
}

std::string NameOf(const DiagnosisReport& s, const std::string& effect) {
  const effect::Words* words = FindWords(s, effect);
  return words == nullptr ? "" : std::string(words->name);
}

}  // namespace

ReportSentences SentencesOf(const DiagnosisReport& s) {
  ReportSentences said;
  said.record_errors = RecordErrorSentences(s.record_errors);
  said.gain = GainSentence(s);
  said.totals = TotalSentences(s.parameters);
  for (const NamedParameter& p : s.parameters) said.brackets.push_back(BracketName(p));
  for (const CalibratedValue& v : s.calibrated) said.significant.push_back(IsSignificant(v));
  if (s.forecast) {
    said.forecast_fit = RangeText(s.forecast->fit_percent, 3);
    for (const ReportForecast::Band& band : s.forecast->by_speed) {
      said.forecast.push_back({RangeText(band.residual_um, 4), RangeText(band.fit_percent, 3)});
    }
  }
  for (const ReportCandidate& c : s.candidates) said.candidates.push_back(NameOf(s, c.effect));
  for (const ReportMark& mark : s.marks) {
    const std::string name = NameOf(s, mark.text);
    said.marks.push_back(
        fmt::format("{}, z = {:.0f} mm", name.empty() ? mark.text : name, 1e3 * mark.z_m));
  }
  return said;
}

}  // namespace levitas::diagnosis
