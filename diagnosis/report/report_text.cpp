#include "diagnosis/report/report_text.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "diagnosis/inference/judging.hpp"
#include "diagnosis/report/advice.hpp"
#include "diagnosis/report/effect_entry.hpp"
#include "diagnosis/report/separations.hpp"
#include "diagnosis/report/validation_check.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

/// ": tau_us 5.21 us (4.9 to 5.5)", the first number of a cause, with its place where it is not the
/// same at all; empty where it has none.
std::string Size(const DiagnosisReport& report, const ReportCause& cause) {
  const auto& parameters = report.parameters;
  const auto first = std::find_if(parameters.begin(), parameters.end(), [&](const auto& p) {
    return p.effect == cause.effect && p.key != kPhaseKey;
  });
  if (first == parameters.end()) return {};
  const bool everywhere = std::all_of(first, parameters.end(), [&first](const auto& p) {
    return p.effect != first->effect || p.key != first->key || p.value == first->value;
  });
  return fmt::format(": {} {:.4g}{}{}{}{}", first->key, first->value,
                     first->unit.empty() ? "" : " ", first->unit,
                     everywhere ? "" : " at " + first->location.name, BracketText(*first));
}

/// Of a rig in which nothing is hidden: how far it is from its file, and what that is worth.
std::string Explained(const DiagnosisReport& report) {
  const auto& values = report.calibrated;
  double furthest = 0.0;
  for (const CalibratedValue& v : values) furthest = std::max(furthest, v.from_file);
  const std::string moved = fmt::format("with its {} numbers moved by at most {:.1f} tolerances",
                                        values.size(), furthest);
  if (!report.validation.meaningful) {
    return "the rig file explains the data to their noise as it stands" +
           (values.empty() ? "" : "; calibration finds it " + moved) + ".";
  }
  return fmt::format(
      "the rig file {} explains the data to their noise; as it stands it does not "
      "({:.1f} times the noise, rms).",
      moved, std::sqrt(report.validation.nominal_over_noise));
}

std::string UnknownText(const ReportResidual& residual) {
  std::string where = fmt::format("{:.0f} Hz", residual.frequency_hz);
  if (residual.order > 0.0) where += fmt::format(", order {:.0f} of rotation", residual.order);
  return fmt::format(
      "A residual is left that no effect of the vocabulary explains: most of all in {} "
      "about {}, following {}.",
      residual.channel, where, residual.coherent_with);
}

/// Of a search that was stopped before it had a cause.
std::string StoppedText(const DiagnosisReport& report) {
  std::string text =
      "The search was stopped before it had found a cause: nothing is proven, and nothing ruled "
      "out.";
  if (report.candidates.empty() || !(report.candidates.front().evidence_nat > kDecisive))
    return text;
  const ReportCandidate& first = report.candidates.front();
  return text + fmt::format(" The likeliest so far: {} at {}, {:.0f} nat.", first.effect,
                            first.place, first.evidence_nat);
}

/// "eddy_current at all axes: tau_us 4.6 us (3 to 6)".
std::string CauseText(const DiagnosisReport& report, const ReportCause& cause) {
  return fmt::format("{} at {}{}", cause.effect, cause.place, Size(report, cause));
}

/// The first cause among the candidates; null where it is not one.
const ReportCandidate* OwnCandidate(const DiagnosisReport& report) {
  if (report.causes.empty()) return nullptr;
  const std::string& effect = report.causes.front().effect;
  const auto own = std::find_if(report.candidates.begin(), report.candidates.end(),
                                [&effect](const auto& c) { return c.effect == effect; });
  return own == report.candidates.end() ? nullptr : &*own;
}

/// Whether validation data say so; not without them.
bool ForetellsLess(const ReportCandidate& candidate, const ReportCandidate& than) {
  return candidate.validation_nat && than.validation_nat &&
         *candidate.validation_nat < *than.validation_nat;
}

/// Every effect with the same prior as a suspected one has (suspicion.hpp).
double ProbabilityOfNone(const std::vector<ReportCandidate>& candidates) {
  double sum = 0.0;
  for (const ReportCandidate& c : candidates) {
    if (std::isfinite(c.evidence_nat)) sum += std::exp(c.evidence_nat);
  }
  const auto effects = static_cast<double>(candidates.size());
  return candidates.empty() ? 1.0 : effects / (effects + sum);
}

/// Why a candidate with decisive evidence is not named.
std::string NotNamed(const DiagnosisReport& report, const ReportCandidate& candidate) {
  if (!candidate.refitted) {
    return "is decisive on the linearised model only, which the nonlinear one was not asked to "
           "confirm";
  }
  if (report.stopped) return "was not tried to the end: the search was stopped";
  if (report.verdict == Verdict::kUnknown) return "does not explain the residual that is left";
  return "is decisive on the fitted samples, but its gain was not confirmed: it scatters like "
         "chance, or does harm where it was not fitted";
}

/// The other causes, and what the data do not separate from the first.
std::string Others(const DiagnosisReport& report) {
  std::string text;
  for (std::size_t i = 1; i < report.causes.size(); ++i) {
    text += "; and " + CauseText(report, report.causes[i]);
  }
  if (!report.also_possible.empty()) {
    text += "; these data do not separate it from";
    for (const auto& other : report.also_possible) text += " " + other;
  }
  return text;
}

std::string Finding(const DiagnosisReport& report) {
  if (report.verdict == Verdict::kSuspected && !report.causes.empty()) {
    return fmt::format("Suspected: {}{}. {}", CauseText(report, report.causes.front()),
                       Others(report), report.suspected_because);
  }
  if (report.verdict == Verdict::kNone) {
    const std::string& limits = report.coverage.sentence;
    return fmt::format("{}{}: {}{}{}", report.undecided ? "Nothing is proven" : "No fault found",
                       limits.empty() ? "" : " as far as these records can show", Explained(report),
                       limits.empty() ? "" : " ", limits);
  }
  if (report.verdict == Verdict::kUnknown || report.causes.empty()) {
    return report.stopped ? StoppedText(report) : UnknownText(report.residual);
  }
  const double nat = OwnEvidence(report);
  std::string text = CauseText(report, report.causes.front()) + "; ";
  text += nat < kDecisive
              ? fmt::format(
                    "named because it is further from the rig file than its tolerances "
                    "allow; calibration could absorb it, which leaves {:.0f} nat for it",
                    nat)
              : fmt::format("{:.0f} nat, which is odds of {} for it", nat, OddsText(nat));
  return text + Others(report) + ".";
}

/// "18 g mm at 0.0 deg"; the amount alone without a phase.
std::string Amount(double value, const std::string& unit, const double* phase_deg) {
  const std::string text = fmt::format("{:.4g} {}", value, unit);
  return phase_deg == nullptr ? text : fmt::format("{} at {:.1f} deg", text, *phase_deg);
}

}  // namespace

std::vector<std::string> OutsideTolerance(const std::vector<CalibratedValue>& calibrated) {
  std::vector<std::string> outside;
  for (const CalibratedValue& v : calibrated) {
    if (!(v.from_file > kOutside)) continue;
    outside.push_back(fmt::format("{}{} of {} ({:.1f} tolerances)",
                                  v.effect.empty() ? "" : v.effect + " ", v.key, v.place,
                                  v.from_file));
  }
  return outside;
}

std::string SuspicionSentence(const DiagnosisReport& report) {
  if (report.verdict != Verdict::kSuspected || report.causes.empty()) return {};
  const double percent = 100.0 * report.probability;
  switch (report.doubt) {
    case Doubt::kWeakEvidence:
      return fmt::format(
          "It is more likely than that nothing is wrong ({:.0f} %), but its {:.1f} nat are not "
          "decisive.",
          percent, OwnEvidence(report));
    case Doubt::kMovedNumber:
      return fmt::format(
          "Calibration moved this number further from the rig file than chance would in all but "
          "{:.2g} % of healthy rigs: either it changed, or the file or its tolerance is wrong.",
          100.0 - percent);
    case Doubt::kUnconfirmed:
      return fmt::format(
          "Its {:.0f} nat on the fitted data are decisive, but the validation data do not confirm "
          "it: what it gains there is within chance.",
          OwnEvidence(report));
    case Doubt::kValidationHarm:
      return fmt::format(
          "Its {:.0f} nat on the fitted data are decisive, but the validation data refute it: "
          "there the calibrated model foretells more without it.",
          OwnEvidence(report));
    case Doubt::kStopped:
      return "The search was stopped before it was complete: not every effect was tried in its "
             "place or beside it.";
    case Doubt::kCutOff:
      return "As many causes as one answer may have are named, and a further one would still gain: "
             "a chain of causes imitates what is in no vocabulary.";
    case Doubt::kResidualIsLeft:
      return fmt::format(
          "It is {:.0f} nat ahead of a rig without it and of every other effect, but it does not "
          "explain all: a residual is left, most of all in {} about {:.0f} Hz, following {}. Its "
          "law is not exactly that of this rig, or something acts besides.",
          OwnEvidence(report), report.residual.channel, report.residual.frequency_hz,
          report.residual.coherent_with);
    case Doubt::kNothing:
      break;
  }
  return {};
}

void CompleteReport(DiagnosisReport& report) {
  report.outside_tolerance = OutsideTolerance(report.calibrated);
  report.suspected_because = SuspicionSentence(report);
  report.confidence = Confidence(report);
  report.undecided = report.verdict == Verdict::kNone && report.confidence < kUndecided;
  report.verdict_sentence = VerdictSentence(report);
  for (ReportCandidate& candidate : report.candidates) candidate.reason = Reason(report, candidate);
  Advise(report);
}

double OwnEvidence(const DiagnosisReport& report) {
  const ReportCandidate* own = OwnCandidate(report);
  return own == nullptr ? report.evidence_nat : own->evidence_nat;
}

std::string BracketText(const NamedParameter& p) {
  if (p.low == p.high) return {};
  return fmt::format(" ({:.4g} to {:.4g}, {})", p.low, p.high, BracketName(p));
}

const char* BracketName(const NamedParameter& p) {
  return p.form ? "neighbouring forms" : "90 % interval";
}

std::string VerdictSentence(const DiagnosisReport& report) {
  std::string text = Finding(report);
  std::string outside;
  if (!report.outside_tolerance.empty()) {
    outside = fmt::format("More than {:.0f} tolerances from the rig file: {}.", kOutside,
                          fmt::join(report.outside_tolerance, ", "));
  }
  for (const std::string& more : {outside, ValidationSentence(report), report.input_warning}) {
    if (!more.empty()) text += " " + more;
  }
  return text;
}

std::string SeparatingExperiment(const DiagnosisReport& report) {
  if (report.stopped) return "none yet: search the same records to the end first";
  if (!PassesValidation(report)) return ValidationExperiment(report);
  if (report.verdict == Verdict::kNone) {
    const std::string& missing = report.coverage.missing_records;
    if (!missing.empty()) return missing;
    return Confidence(report) < kUndecided ? kToDecide : kNoneNeeded;
  }
  if (report.verdict == Verdict::kUnknown || report.doubt == Doubt::kResidualIsLeft ||
      report.doubt == Doubt::kCutOff) {
    return "the same with another speed and another bias current: the change of the residual "
           "shows whether it belongs to the rotation, the magnets or neither";
  }
  if (report.doubt == Doubt::kValidationHarm || report.doubt == Doubt::kUnconfirmed)
    return ValidationExperiment(report);
  if (report.doubt == Doubt::kMovedNumber) {
    return "records of the healthy rig (--healthy), or this number measured by itself: the rig "
           "file may be wrong";
  }
  const bool weak = report.doubt == Doubt::kWeakEvidence;
  if (report.causes.empty() || (report.also_possible.empty() && !weak)) return kNoneNeeded;
  if (const effect::Row* cause = effect::Find(report.causes.front().effect)) {
    const std::string_view record =
        SeparatingRecord(cause->id, effect::IdsOf(report.also_possible));
    if (!record.empty()) return std::string(record);
  }
  return "a longer record with a stronger test signal, standing and at two speeds";
}

std::string NextExperiment(const DiagnosisReport& report, const std::string& experiment) {
  std::string check;
  if (!report.input_warning.empty()) {
    check = "check units and signs of the columns and the rig file, and diagnose again";
  } else if (report.changed_since_healthy) {
    check = "check that the healthy records are of this rig, as it was before";
  }
  if (check.empty() && report.verdict == Verdict::kNone && report.healthy_sentence.empty() &&
      !MeasurablyOff(report).empty()) {
    check = "records of this rig in good order (--healthy)";
  }
  if (check.empty()) return experiment;
  return experiment == kNoneNeeded ? check : fmt::format("{}; then {}", check, experiment);
}

double Confidence(const DiagnosisReport& report) {
  const auto& candidates = report.candidates;
  if (report.verdict == Verdict::kUnknown) return 0.0;
  if (report.verdict == Verdict::kSuspected) return report.probability;
  if (report.verdict == Verdict::kNone) return ProbabilityOfNone(candidates);
  if (candidates.empty()) return 0.0;
  const ReportCandidate* own = OwnCandidate(report);
  const ReportCandidate& first = own == nullptr ? candidates.front() : *own;
  double best = 0.0;
  for (const ReportCandidate& c : candidates) {
    if (!ForetellsLess(c, first)) best = std::max(best, c.evidence_nat);
  }
  double sum = std::exp(-best);
  for (const ReportCandidate& c : candidates) {
    // What validation data refuted does not count, whatever the fitted data say.
    if (ForetellsLess(c, first)) continue;
    if (std::isfinite(c.evidence_nat)) sum += std::exp(c.evidence_nat - best);
  }
  return std::exp(first.evidence_nat - best) / sum;
}

std::string Reason(const DiagnosisReport& report, const ReportCandidate& candidate) {
  for (const ReportCause& cause : report.causes) {
    if (cause.effect == candidate.effect) return "named";
  }
  if (!candidate.reason.empty()) return candidate.reason;
  const auto& tied = report.also_possible;
  if (std::find(tied.begin(), tied.end(), candidate.effect) != tied.end()) {
    return "these data do not separate it from the cause";
  }
  const ReportCandidate* own = OwnCandidate(report);
  if (own != nullptr && ForetellsLess(candidate, *own)) {
    return fmt::format("foretells the validation data {:.0f} nat worse than the cause",
                       *own->validation_nat - *candidate.validation_nat);
  }
  if (!std::isfinite(candidate.evidence_nat)) {
    return "would have to be negative, or cannot act in these data";
  }
  if (candidate.evidence_nat < kDecisive) {
    return candidate.evidence_nat < 0.0 ? "improves the fit by less than its Occam factor costs"
                                        : "too little to be decisive";
  }
  const double behind = OwnEvidence(report) - candidate.evidence_nat;
  if (report.causes.empty() || behind < 0.0) return NotNamed(report, candidate);
  return fmt::format("explains {:.0f} nat less than the cause", behind);
}

std::vector<std::string> TotalSentences(const std::vector<NamedParameter>& parameters) {
  std::vector<std::string> sentences;
  for (const NamedParameter& p : parameters) {
    if (!p.of_file || p.key == kPhaseKey) continue;
    if (p.key == kDelaySamplesKey) {
      sentences.push_back(fmt::format("the delay is {:.4g} samples, the rig file says {:.4g}",
                                      p.value, p.of_file->nominal));
      continue;
    }
    const auto phase = std::find_if(parameters.begin(), parameters.end(), [&](const auto& other) {
      return other.effect == p.effect && other.location.name == p.location.name &&
             other.key == kPhaseKey && other.of_file;
    });
    const bool turned = phase != parameters.end();
    sentences.push_back(fmt::format(
        "{} at {}: {} is added to the {} that the rig file has there: in all {}", p.effect,
        p.location.name, Amount(p.value, p.unit, turned ? &phase->value : nullptr),
        Amount(p.of_file->nominal, p.unit, turned ? &phase->of_file->nominal : nullptr),
        Amount(p.of_file->total, p.unit, turned ? &phase->of_file->total : nullptr)));
  }
  return sentences;
}

bool IsSignificant(const CalibratedValue& value) {
  constexpr double kTolerances = 0.5;
  constexpr double kDeviations = 2.0;
  return value.moved > kTolerances && value.proven > kDeviations;
}

}  // namespace levitas::diagnosis
