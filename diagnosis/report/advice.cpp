#include "diagnosis/report/advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/report/effect_entry.hpp"
#include "diagnosis/report/report_text.hpp"
#include "diagnosis/report/severity.hpp"

namespace levitas::diagnosis {
namespace {

using effect::SizeForm;
using effect::Words;

double NeutralOf(const Words& words) { return words.form == SizeForm::kOff ? 1.0 : 0.0; }

/// The parameter that says how large the cause is: of several places the furthest from neutral.
const NamedParameter* SizeOf(const DiagnosisReport& report, const Words& words) {
  const NamedParameter* largest = nullptr;
  for (const NamedParameter& p : report.parameters) {
    if (p.effect != words.effect || words.size.empty() || !p.key.starts_with(words.size)) continue;
    const auto off = [&](const NamedParameter& at) {
      return std::abs(at.value - NeutralOf(words));
    };
    if (largest == nullptr || off(p) > off(*largest)) largest = &p;
  }
  return largest;
}

/// Of a cause that has a size at every axis by itself: whether this axis has much of it, and to the
/// same side as the worst one. The sentence about the worst would be wrong of the others.
bool IsMeant(const NamedParameter& p, const NamedParameter* largest, double neutral) {
  constexpr double kMuch = 0.2;  // of the largest
  if (largest == nullptr || p.key != largest->key || largest->value == neutral) return true;
  return (p.value - neutral) / (largest->value - neutral) >= kMuch;
}

bool IsSame(const DiagnosisReport& report, const NamedParameter& size, double neutral) {
  return std::all_of(report.parameters.begin(), report.parameters.end(), [&](const auto& p) {
    return p.effect != size.effect || p.key != size.key || p.value == size.value ||
           !IsMeant(p, &size, neutral);
  });
}

/// [samples] A delay under this key is the whole one.
double DelayOfFile(const NamedParameter& delay) {
  return delay.of_file ? delay.of_file->nominal : 0.0;
}

std::string SizeText(const DiagnosisReport& report, const Words& words) {
  const NamedParameter* size = SizeOf(report, words);
  if (size == nullptr) return {};
  if (size->key == kDelaySamplesKey) {
    return fmt::format(", {:.3g} samples where the file says {:.3g}", size->value,
                       DelayOfFile(*size));
  }
  const bool up_to = !IsSame(report, *size, NeutralOf(words));
  // Where there is a word for the other side, the sign is said by the name.
  const double said = words.opposite.empty() ? size->value : std::abs(size->value);
  std::string number;
  switch (words.form) {
    case SizeForm::kPlain:
      number = fmt::format("{:.3g}{}{}", said, size->unit.empty() ? "" : " ", size->unit);
      break;
    case SizeForm::kPercent:
      number = fmt::format("{:.2g} %", 100.0 * said);
      break;
    case SizeForm::kOff:
      number =
          fmt::format("by {}{:.2g} %", up_to ? "up to " : "", 100.0 * std::abs(size->value - 1.0));
      return ", " + number;
  }
  return fmt::format(", {}{}{}{}", up_to ? "up to " : "", number, words.of.empty() ? "" : " ",
                     words.of);
}

std::string_view NameOf(const DiagnosisReport& report, const Words& words) {
  const NamedParameter* size = SizeOf(report, words);
  if (words.opposite.empty() || size == nullptr) return words.name;
  if (size->key == kDelaySamplesKey) {
    return size->value < DelayOfFile(*size) ? words.opposite : words.name;
  }
  return size->value < NeutralOf(words) ? words.opposite : words.name;
}

/// One place of a parameter: "near z = 241 mm", "at de_x", "of bending mode 2", "at 50 Hz".
std::string At(const DiagnosisReport& report, const NamedParameter& p) {
  const Location& at = p.location;
  std::string text;
  if (at.axis && *at.axis < report.rig_channels.size()) {
    text = "at " + report.rig_channels[*at.axis];
  } else if (at.bearing || at.gear) {
    text = "at " + at.name.substr(0, at.name.find(", "));
  } else if (at.z_m) {
    text = fmt::format("near z = {:.0f} mm", 1e3 * *at.z_m);
  }
  if (at.mode) text += fmt::format("{}(bending mode {})", text.empty() ? "" : " ", *at.mode);
  if (at.order) text += fmt::format("{}(order {})", text.empty() ? "" : " ", *at.order);
  if (at.frequency_hz) text += fmt::format(" ({:.0f} Hz)", *at.frequency_hz);
  return text;
}

std::string PlaceText(const DiagnosisReport& report, const ReportCause& cause) {
  std::vector<std::string> places;
  std::size_t own = 0;
  const Words* words = FindWords(report, cause.effect);
  const NamedParameter* largest = words == nullptr ? nullptr : SizeOf(report, *words);
  for (const NamedParameter& p : report.parameters) {
    if (p.effect != cause.effect) continue;
    ++own;
    if (words != nullptr && !IsMeant(p, largest, NeutralOf(*words))) continue;
    if (p.key == "z_mm") return fmt::format(" near z = {:.0f} mm", p.value);
    std::string at = At(report, p);
    // "at de_x, de_y", not "at de_x, at de_y".
    if (!places.empty() && at.starts_with("at ")) at.erase(0, 3);
    const bool known = std::find(places.begin(), places.end(), at) != places.end() ||
                       (!places.empty() && places.front() == "at " + at);
    if (!at.empty() && !known) places.push_back(at);
  }
  if (own == 0) return cause.place.empty() ? "" : fmt::format(" ({})", cause.place);
  if (places.empty()) return {};
  const bool everywhere = places.size() > 1 && places.size() == report.rig_channels.size();
  return everywhere ? " on all axes" : fmt::format(" {}", fmt::join(places, ", "));
}

Severity Worse(Severity one, Severity other) { return std::max(one, other); }

struct Judged {
  Severity severity{Severity::kNotSaid};
  std::string sentence;
};

Judged SeverityOf(const DiagnosisReport& report, const ReportCause& cause) {
  const Words* words = FindWords(report, cause.effect);
  if (words == nullptr) return {};
  const NamedParameter* size = SizeOf(report, *words);
  Judgement judged;
  if (size != nullptr || words->yardstick == effect::Yardstick::kGrows) {
    judged =
        JudgeSize(words->yardstick, size == nullptr ? 0.0 : size->value * size->si, report.scale);
  }
  std::string text(words->does);
  text += judged.severity == Severity::kNotSaid
              ? " How severe that is, orbit and currents say, not the size alone."
              : fmt::format(" {}: {}.", Name(judged.severity), judged.sentence);
  return {judged.severity, text};
}

/// Whether to stop; `certain` of a cause that is named.
std::string StopText(const Words& words, Severity severity, bool certain) {
  const bool severe = severity == Severity::kSevere;
  if (words.stop == effect::Stop::kAtOnce || (words.stop == effect::Stop::kIfSevere && severe)) {
    return certain ? "Stop the machine. " : "Run no further than you must until this is settled. ";
  }
  if (words.stop == effect::Stop::kRunOn) return "The machine may run on. ";
  return severity == Severity::kNotSaid
             ? "The machine may run on while orbit and currents stay in their zones (amb report). "
             : "The machine may run on. ";
}

/// Whether the model with the causes foretells the validation data worse than the rig file does.
bool ForetellsWorse(const DiagnosisReport& report) {
  constexpr double kWorsePercent = 1.0;
  return report.verdict == Verdict::kSuspected &&
         report.validation.extended_percent < report.validation.nominal_percent - kWorsePercent;
}

std::string ActionOfCauses(const DiagnosisReport& report) {
  const bool certain = report.verdict == Verdict::kEffect;
  std::string text = ForetellsWorse(report)
                         ? "Change nothing yet: see further records. Meanwhile may be checked: "
                         : "";
  for (const ReportCause& cause : report.causes) {
    const Words* words = FindWords(report, cause.effect);
    if (words == nullptr) continue;
    const std::string stop = StopText(*words, SeverityOf(report, cause).severity, certain);
    if (text.find(stop) == std::string::npos) text += stop;
    if (text.find(words->check) == std::string::npos) text += fmt::format("{} ", words->check);
  }
  for (const std::string& other : report.also_possible) {
    const Words* words = FindWords(report, other);
    if (words != nullptr) text += fmt::format("If it is the {}: {} ", other, words->check);
  }
  if (!text.empty()) text.pop_back();
  return text;
}

std::string ActionText(const DiagnosisReport& report) {
  if (!report.input_warning.empty()) {
    return "First check units and signs of the columns and the rig file, and diagnose again; "
           "change nothing on the machine before.";
  }
  if (!report.causes.empty()) return ActionOfCauses(report);
  if (report.stopped) return "Diagnose again, to the end, before anything is changed.";
  if (report.verdict == Verdict::kUnknown) {
    return "Look for a disturbance at this frequency: other machines, mains, crosstalk of cables, "
           "loose parts. Run on only while orbit and currents stay in their zones (amb report).";
  }
  if (report.undecided) return "Decide first: see further records. The machine may run on.";
  if (report.changed_since_healthy) {
    return "Check that the healthy records are of this rig; if so, look at what has changed.";
  }
  if (!AllInOrder(report)) return "None on the machine; compare it with records of its good order.";
  return report.coverage.sentence.empty() ? "None." : "None, as far as these records can show.";
}

std::string OffText(const CalibratedValue& v) {
  return fmt::format(
      "{} of {} is {:.4g}{}{} where {:.4g} was expected ({:.0f} standard "
      "deviations, {:.1f} tolerances)",
      v.effect.empty() ? v.key : v.effect + " " + v.key, v.place, v.calibrated,
      v.unit.empty() ? "" : " ", v.unit, v.expected, v.proven, v.moved);
}

std::string HeadlineOfNone(const DiagnosisReport& report) {
  const std::string sure = "confidence " + PercentText(report.confidence);
  if (report.undecided) {
    const ReportCandidate& first = report.candidates.front();
    return fmt::format(
        "Undecided: the rig file explains the records, but {} [{}] may be there ({:.0f} nat, odds "
        "{}; it {}; {} that nothing is wrong).",
        InWords(report, {first.effect, first.place}), first.effect, first.evidence_nat,
        OddsText(first.evidence_nat), Reason(report, first), sure);
  }
  const std::string limits =
      report.coverage.sentence.empty() ? "" : " as far as these records can show";
  const auto off = MeasurablyOff(report);
  if (!off.empty()) {
    return fmt::format("No fault proven{} ({}), but {} of the rig file {} measurably off: {}.",
                       limits, sure,
                       off.size() == 1 ? "one number" : fmt::format("{} numbers", off.size()),
                       off.size() == 1 ? "is" : "are", OffText(off.front()));
  }
  return fmt::format("No fault found{} ({}).", limits, sure);
}

std::string CauseLine(const DiagnosisReport& report, const ReportCause& cause) {
  return fmt::format("{} [{}]", InWords(report, cause), cause.effect);
}

std::string HeadlineOfCauses(const DiagnosisReport& report) {
  std::string text = CauseLine(report, report.causes.front());
  for (std::size_t i = 1; i < report.causes.size(); ++i) {
    // The line of an effect says all its places: one that is a cause at two stands there once.
    const std::string line = CauseLine(report, report.causes[i]);
    if (text.find(line) == std::string::npos) text += "; and " + line;
  }
  const std::string percent = PercentText(report.confidence);
  if (ForetellsWorse(report)) {
    // What is that likely is that something is wrong, not that it is this.
    return fmt::format(
        "Something is wrong ({}), and what is not proven: the likeliest so far, {}, foretells the "
        "validation data worse than the rig file itself ({:.1f} against {:.1f} %).",
        percent, text, report.validation.extended_percent, report.validation.nominal_percent);
  }
  if (report.verdict == Verdict::kSuspected) {
    text = fmt::format("Suspected, {}: {}", percent, text);
  } else {
    text +=
        fmt::format(": {} ({}), odds {}", report.certainty, percent, OddsText(OwnEvidence(report)));
  }
  if (report.also_possible.empty()) return text + ".";
  std::vector<std::string> others;
  for (const std::string& other : report.also_possible) {
    const Words* words = FindWords(report, other);
    others.push_back(words == nullptr ? other : fmt::format("{} [{}]", words->name, other));
  }
  return fmt::format("{}. Just as possible: {}.", text, fmt::join(others, "; "));
}

std::string HeadlineOfUnknown(const ReportResidual& residual) {
  return fmt::format(
      "Something acts that no known effect explains: most in {} about {:.0f} Hz, "
      "following {}.",
      residual.channel, residual.frequency_hz, residual.coherent_with);
}

std::string Headline(const DiagnosisReport& report) {
  std::string text;
  if (report.verdict == Verdict::kNone) {
    text = HeadlineOfNone(report);
  } else {
    text = !report.causes.empty() ? HeadlineOfCauses(report)
           : report.stopped       ? "Stopped before a cause was found."
                                  : HeadlineOfUnknown(report.residual);
  }
  return report.input_warning.empty() ? text : "Doubtful, check the inputs first. " + text;
}

std::string HealthyProposal(const DiagnosisReport& report) {
  const auto off = MeasurablyOff(report);
  if (report.verdict != Verdict::kNone || off.empty() || !report.healthy_sentence.empty())
    return {};
  return fmt::format(
      "The tolerances of the rig file allow {}, the data show {} to be off. Whether that is new, "
      "records of this rig in good order tell: diagnose again with --healthy.",
      off.size() == 1 ? "it" : "them", off.size() == 1 ? "it" : "them");
}

}  // namespace

const Words* FindWords(const DiagnosisReport& report, const std::string& effect) {
  for (const Words& own : report.own_words) {
    if (own.effect == effect) return &own;
  }
  return effect::FindWords(effect);
}

std::string InWords(const DiagnosisReport& report, const ReportCause& cause) {
  const Words* words = FindWords(report, cause.effect);
  if (words == nullptr) return fmt::format("{} at {}", cause.effect, cause.place);
  return fmt::format("{}{}{}", NameOf(report, *words), PlaceText(report, cause),
                     SizeText(report, *words));
}

std::string OddsText(double nat) {
  const double power = std::floor(nat * std::numbers::log10e);
  if (power >= 1.0) return fmt::format("10^{:.0f} : 1", power);
  return fmt::format("{:.2g} : 1", std::exp(nat));
}

std::string PercentText(double share) {
  constexpr double kLeast = 0.001;
  if (share < kLeast) return "under 0.1 %";
  if (share > 1.0 - kLeast) return "over 99.9 %";
  const bool near_end = share < 0.01 || share > 0.99;
  return fmt::format("{:.{}f} %", 100.0 * share, near_end ? 1 : 0);
}

std::string CertaintyText(double confidence) {
  constexpr double kNearly = 0.99;
  constexpr double kVery = 0.9;
  constexpr double kLikely = 0.5;
  if (confidence >= kNearly) return "nearly certain";
  if (confidence >= kVery) return "very likely";
  return confidence >= kLikely ? "likely" : "one of several that are possible";
}

std::vector<CalibratedValue> MeasurablyOff(const DiagnosisReport& report) {
  std::vector<CalibratedValue> off;
  std::copy_if(report.calibrated.begin(), report.calibrated.end(), std::back_inserter(off),
               [](const CalibratedValue& v) { return v.proven > kMeasurablyOff; });
  std::stable_sort(off.begin(), off.end(), [](const CalibratedValue& a, const CalibratedValue& b) {
    return a.moved > b.moved;
  });
  return off;
}

bool AllInOrder(const DiagnosisReport& report) {
  return report.verdict == Verdict::kNone && report.causes.empty() && !report.undecided &&
         MeasurablyOff(report).empty() && report.outside_tolerance.empty() &&
         report.input_warning.empty() && !report.changed_since_healthy;
}

const char* Name(Severity severity) {
  switch (severity) {
    case Severity::kSlight:
      return "Slight";
    case Severity::kMarked:
      return "Marked";
    case Severity::kSevere:
      return "Severe";
    case Severity::kNotSaid:
      break;
  }
  return "Not said";
}

void Advise(DiagnosisReport& report) {
  report.certainty = report.verdict == Verdict::kUnknown ? "" : CertaintyText(report.confidence);
  report.headline = Headline(report);
  report.action = ActionText(report);
  report.healthy_proposal = HealthyProposal(report);
  report.severity = Severity::kNotSaid;
  report.severity_sentence.clear();
  for (const ReportCause& cause : report.causes) {
    const Judged judged = SeverityOf(report, cause);
    report.severity = Worse(report.severity, judged.severity);
    if (report.severity_sentence.find(judged.sentence) != std::string::npos) continue;
    if (!report.severity_sentence.empty()) report.severity_sentence += " ";
    report.severity_sentence += judged.sentence;
  }
}

}  // namespace levitas::diagnosis
