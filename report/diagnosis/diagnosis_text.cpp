#include "report/diagnosis/diagnosis_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/inference/judging.hpp"
#include "diagnosis/report/report_text.hpp"
#include "report/text/text_table.hpp"

namespace levitas::report {
namespace {

using diagnosis::CalibratedValue;
using diagnosis::DiagnosisReport;
using diagnosis::NamedParameter;
using diagnosis::ReportFit;
using diagnosis::ReportRun;
using diagnosis::ReportRunFit;
using diagnosis::ReportSentences;

constexpr std::size_t kShown = 8;
constexpr double kLeastShare = 0.01;  ///< of the rig file's error, to be said of calibration

/// What to know first: what it is, what it does, what to do.
void PrintAdvice(const DiagnosisReport& s) {
  fmt::print("{}\n", s.headline);
  if (!s.severity_sentence.empty()) fmt::print("What it does: {}\n", s.severity_sentence);
  fmt::print("Action: {}\n", s.action);
  const std::string healthy = HealthyProposalText(s);
  if (!healthy.empty()) fmt::print("{}\n", healthy);
  fmt::print("\n");
}

void PrintParameters(const DiagnosisReport& s, const ReportSentences& said) {
  const auto parameters = SharedParameters(s, said);
  if (parameters.empty()) return;
  fmt::print("Parameters, keys and units as in a rig file:\n");
  bool form = false;
  for (const SharedParameter& shared : parameters) {
    const NamedParameter& p = shared.parameter;
    const std::string unit = p.unit.empty() ? "" : " " + p.unit;
    fmt::print("  {} {}: {:.5g}{}{}, {}\n", p.effect, p.key, p.value, unit,
               diagnosis::BracketText(p), shared.places);
    form = form || p.form;
  }
  if (form) {
    fmt::print(
        "  (neighbouring forms: of a grid that was tried; not how well the value is known)\n");
  }
  for (const std::string& total : said.totals) fmt::print("  {}\n", total);
  fmt::print("\n");
}

void PrintCalibrated(const DiagnosisReport& s, const ReportSentences& said, bool complete) {
  const auto& values = s.calibrated;
  std::vector<CalibratedValue> shown;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (complete || said.significant[i]) shown.push_back(values[i]);
  }
  if (!complete && shown.size() > kShown) shown.resize(kShown);
  fmt::print("Calibration: {} numbers in which a healthy rig may differ from its file; ",
             values.size());
  if (!s.taken_by_causes.empty()) {
    fmt::print("{} not among them, being a cause; ", fmt::join(s.taken_by_causes, ", "));
  }
  if (shown.empty()) {
    fmt::print(
        "none measurably further than half its tolerance from it (--explain lists them).\n\n");
    return;
  }
  fmt::print("{}:\n", complete ? "all of them" : "furthest out (--explain lists all)");
  TextTable table;
  table.Add({"", "where", "key", "rig file", "calibrated", "std", "tolerance"});
  for (const CalibratedValue& v : shown) {
    table.Add({"  " + v.effect, v.place, v.key, AtPhase(v.nominal, v.nominal_phase_rad),
               AtPhase(v.calibrated, v.phase_rad), fmt::format("{:.2g}", v.deviation),
               fmt::format("{:.2g}", v.tolerance)});
  }
  fmt::print("{}", table.Text());
  fmt::print("\n");
}

void PrintFits(const DiagnosisReport& s, const ReportSentences& said) {
  fmt::print("{:<46}{:>9}{:>12}{:>10}{:>9}\n", "Fit of the one-step prediction, percent", "nominal",
             "calibrated", "extended", "ceiling");
  const auto row = [](const char* name, const ReportFit& g) {
    fmt::print("{:<46}{:>9.2f}{:>12.2f}{:>10.2f}{:>9.2f}\n", name, g.nominal_percent,
               g.calibrated_percent, g.extended_percent, g.ceiling_percent);
  };
  row("  on fitted data", s.fitted);
  row("  on validation data", s.validation);
  const std::string remarks = FitRemarks(s);
  fmt::print("{}\n{}{}", said.gain, remarks, remarks.empty() ? "" : "\n");
  const std::string shares = ErrorSharesSentence(s);
  if (!shares.empty()) fmt::print("{}\n", shares);
}

/// Speed by speed: what was to be expected of the forecast, and what was measured.
void PrintForecast(const DiagnosisReport& s, const ReportSentences& said) {
  if (!s.forecast || s.forecast->by_speed.empty()) return;
  const auto text = [](bool covered) { return covered ? "covered" : "not covered"; };
  const diagnosis::ReportForeseen& fit = s.forecast->fit_percent;
  fmt::print(
      "Forecast of stretches of the validation data, 90 % interval from the fitted data alone: fit "
      "{} %, measured {:.1f} %: {}. Chance to beat the rig file: {:.0f} %.\n",
      said.forecast_fit, fit.measured, text(fit.covered), 100.0 * s.forecast->better_than_file);
  for (std::size_t i = 0; i < said.forecast.size(); ++i) {
    const auto& band = s.forecast->by_speed[i];
    fmt::print("  {:>6.0f} to {:>6.0f} rpm: residual {} um rms, measured {:.4g}: {}\n",
               band.from_rpm, band.to_rpm, said.forecast[i].residual_um, band.residual_um.measured,
               text(band.residual_um.covered));
  }
}

void PrintRanking(const DiagnosisReport& s, bool complete) {
  const auto& candidates = s.candidates;
  const std::size_t shown = complete ? candidates.size() : std::min(kShown, candidates.size());
  fmt::print("\n{:<26}{:<42}{:>10}\n", "effect", "where", "nat");
  bool screened = false;
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& c = candidates[i];
    const bool said = c.evidence_nat >= diagnosis::kDecisive && !c.reason.empty();
    fmt::print("{:<26}{:<42}{:>10.1f}{}{}{}\n", c.effect, c.place, c.evidence_nat,
               c.refitted ? "" : "  (screen)", said ? "  " : "", said ? c.reason : "");
    screened = screened || !c.refitted;
  }
  if (screened) {
    fmt::print("(screen): from the linearised model; too far behind to be refitted\n");
  }
}

/// Ties of all causes; those of the first are in the verdict's sentence as well.
void PrintTies(const DiagnosisReport& s) {
  for (const diagnosis::ReportTie& tie : s.ties) {
    if (tie.others.empty()) continue;
    fmt::print("{} is not separable from {}\n", tie.cause, fmt::join(tie.others, " "));
  }
}

void PrintRuns(const DiagnosisReport& s) {
  if (s.validation_runs.empty()) return;
  fmt::print(
      "\nFit on runs that were not fitted, percent (I: current in free run, x: motion one "
      "step ahead)\n");
  fmt::print("{:<22}{:>9}{:>12}{:>10}{:>18}{:>9}\n", "", "nominal", "calibrated", "extended",
             "5 to 95 %", "ceiling");
  const auto row = [](const std::string& name, const ReportRunFit& fit) {
    fmt::print("{:<22}{:>9.2f}{:>12.2f}{:>10.2f}{:>18}{:>9.2f}\n", name, fit.nominal.value,
               fit.calibrated.value, fit.extended.value, IntervalText(fit), fit.ceiling_percent);
  };
  for (const ReportRun& run : s.validation_runs) {
    if (run.current) row(run.name + " I", *run.current);
    row(run.name + " x", run.motion);
  }
}

constexpr double kSameDigits = 0.005;  // what rounds to the same two digits

bool Above(const ReportFit& g) {
  return std::max(g.extended_percent, g.calibrated_percent) > g.ceiling_percent + kSameDigits;
}

}  // namespace

std::vector<SharedParameter> SharedParameters(const DiagnosisReport& s,
                                              const ReportSentences& said) {
  struct Places {
    NamedParameter first;
    const char* bracket{};
    std::vector<std::string> at;
  };
  std::vector<Places> groups;
  for (std::size_t i = 0; i < s.parameters.size(); ++i) {
    const NamedParameter& p = s.parameters[i];
    const auto same = std::find_if(groups.begin(), groups.end(), [&p](const Places& g) {
      return g.first.effect == p.effect && g.first.key == p.key && g.first.value == p.value &&
             g.first.low == p.low && g.first.high == p.high;
    });
    (same == groups.end() ? groups.emplace_back(Places{p, said.brackets[i], {}}) : *same)
        .at.push_back(p.location.name);
  }
  std::vector<SharedParameter> out;
  for (const Places& g : groups) {
    std::string places;
    for (const std::string& place : g.at) places += (places.empty() ? "" : ", ") + place;
    const bool all = g.at.size() > 1 && g.at == s.rig_channels;
    out.push_back({g.first, all ? "all axes" : places, g.bracket});
  }
  return out;
}

std::string IntervalText(const ReportRunFit& fit) {
  return fmt::format("{:.1f} to {:.1f}", fit.extended.low, fit.extended.high);
}

std::string AtPhase(double value, std::optional<double> phase_rad) {
  return phase_rad
             ? fmt::format("{:.4g} at {:.1f} deg", value, 180.0 / std::numbers::pi * *phase_rad)
             : fmt::format("{:.5g}", value);
}

std::string FurtherRecords(const DiagnosisReport& s) {
  if (s.next_experiment != diagnosis::kNoneNeeded) return s.next_experiment;
  return s.causes.empty() ? "none needed" : "none needed to name the cause";
}

std::string ErrorSharesSentence(const DiagnosisReport& s) {
  if (!s.fitted.meaningful) return {};
  std::vector<std::string> parts;
  for (const diagnosis::ReportErrorShare& e : s.error_shares) {
    if (e.place.empty() && !(std::abs(e.fraction) >= kLeastShare)) continue;
    const std::string name = e.effect.empty() ? "shapes of the modes" : e.effect;
    parts.push_back(fmt::format("{}{} {:.0f} %", name, e.place.empty() ? " (calibrated)" : "",
                                100.0 * e.fraction));
  }
  if (parts.empty()) return {};
  return fmt::format("Of what the rig file gets wrong on the fitted data: {}.",
                     fmt::join(parts, ", "));
}

std::string HealthyProposalText(const DiagnosisReport& s) {
  if (s.healthy_proposal.empty() || s.healthy_record.empty()) return s.healthy_proposal;
  return fmt::format("{} The last accepted session of this rig: --healthy {}", s.healthy_proposal,
                     s.healthy_record);
}

std::string FitRemarks(const DiagnosisReport& s) {
  std::vector<std::string> remarks;
  if (Above(s.fitted) || Above(s.validation)) {
    remarks.emplace_back(
        "A fit above the ceiling is at the ceiling: the noise is read from the highest third of "
        "the spectrum, to a few per cent.");
  }
  if (s.fitted.calibrated_percent < s.fitted.nominal_percent - kSameDigits) {
    remarks.emplace_back(
        "Calibrated below nominal on the fitted data is no loss: calibration weighs every "
        "frequency by its noise, which a fit in percent does not.");
  }
  return fmt::format("{}", fmt::join(remarks, " "));
}

void PrintDiagnosis(const DiagnosisReport& s, bool complete) {
  const ReportSentences said = diagnosis::SentencesOf(s);
  for (const std::string& sentence : said.record_errors) fmt::print("{}\n", sentence);
  if (!s.record_errors.empty()) fmt::print("{}\n\n", diagnosis::kAsMended);
  PrintAdvice(s);
  fmt::print("In detail: {}\n\n", s.verdict_sentence);
  if (!s.healthy_sentence.empty()) fmt::print("{}\n\n", s.healthy_sentence);
  PrintParameters(s, said);
  PrintCalibrated(s, said, complete);
  PrintFits(s, said);
  PrintForecast(s, said);
  PrintRanking(s, complete);
  fmt::print("\nFurther records: {}\n", FurtherRecords(s));
  PrintTies(s);
  PrintRuns(s);
  for (const std::string& sentence : s.levitation.sentences) fmt::print("\n{}\n", sentence);
}

}  // namespace levitas::report
