#include "report/diagnosis/diagnosis_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/report/advice.hpp"
#include "diagnosis/report/report_text.hpp"
#include "report/diagnosis/diagnosis_text.hpp"
#include "report/diagnosis/forecast_section.hpp"
#include "report/diagnosis/rotor_sketch.hpp"
#include "report/svg/escaped_text.hpp"
#include "report/svg/figure.hpp"

namespace levitas::cli {
namespace {

using diagnosis::DiagnosisReport;
using diagnosis::ReportCandidate;
using diagnosis::ReportFit;
using diagnosis::ReportRunFit;

constexpr const char* kStyle =
    "body{font:16px/1.5 sans-serif;max-width:64em;margin:2em auto;padding:0 1em;color:#222}"
    "h1{font-size:1.5em}.verdict{font-size:1.25em;padding:.8em "
    "1em;background:#eef4fb;border-left:6px "
    "solid #1f77b4}.verdict.severe{background:#fdecea;border-color:#d62728}.verdict.marked{"
    "background:#fff4e5;border-color:#e08a00}.advice td{vertical-align:top;border:0;padding:.25em "
    ".6em .25em 0}.advice "
    "td.k{font-weight:bold}.origin{color:#555;font-size:.9em}table{border-collapse:collapse}td,th{"
    "padding:.2em .6em;text-align:left;"
    "border-bottom:1px solid "
    "#ddd}td.n{text-align:right;white-space:nowrap}td.k{white-space:nowrap}svg{max-width:100%;"
    "margin:1em "
    "0}.bar{background:#eee;"
    "width:24em}"
    ".bar div{height:1em}summary{cursor:pointer;padding:.4em 0}";

using svg::Escaped;

svg::Series Line(const char* name, const char* colour, const std::vector<double>& ratio,
                 double spacing_hz) {
  svg::Series line{.name = name};
  line.colour = colour;
  for (std::size_t i = 1; i < ratio.size(); ++i) {
    line.x.push_back(static_cast<double>(i) * spacing_hz);
    line.y.push_back(ratio[i]);
  }
  return line;
}

std::string Spectra(const DiagnosisReport& s) {
  svg::Panel panel;
  const diagnosis::ReportSpectra& spectra = s.spectra;
  panel.title = "What the model leaves of the data used, in " + spectra.channel;
  panel.x_label = "frequency, Hz";
  panel.y_label = "residual power / sensor noise power, 1";
  panel.x_scale = svg::Scale::kLogarithmic;
  panel.y_scale = svg::Scale::kLogarithmic;
  panel.series = {Line("rig file", "#888888", spectra.nominal, spectra.line_spacing_hz),
                  Line("calibrated", "#1f77b4", spectra.calibrated, spectra.line_spacing_hz)};
  if (!s.causes.empty()) {
    panel.series.back().width = 2.6;  // else the cause's line hides it
    panel.series.push_back(
        Line("with the cause", "#d62728", spectra.extended, spectra.line_spacing_hz));
  }
  svg::Figure figure;
  figure.panel_width = 760;
  figure.panels = {panel};
  return svg::Draw(figure);
}

std::string NameInWords(const DiagnosisReport& s, const std::string& effect) {
  const effect::Words* words = diagnosis::FindWords(s, effect);
  return words == nullptr ? "" : Escaped(std::string(words->name));
}

std::string Ranking(const DiagnosisReport& s) {
  constexpr std::size_t kShown = 8;
  std::string rows;
  std::string rest;
  for (std::size_t i = 0; i < s.candidates.size(); ++i) {
    const ReportCandidate& c = s.candidates[i];
    const std::string score =
        std::isfinite(c.evidence_nat) ? fmt::format("{:.1f}", c.evidence_nat) : "-";
    (i < kShown ? rows : rest) +=
        fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td class=n>{}</td><td>{}</td></tr>\n",
                    NameInWords(s, c.effect), c.effect, Escaped(c.place), score, c.reason);
  }
  const std::string head =
      "<table><tr><th>what</th><th>effect</th><th>where</th><th>evidence, nat</th><th>why it is "
      "not the answer</th></tr>\n";
  return head + rows + "</table>\n<details><summary>All others that were ruled out</summary>" +
         head + rest + "</table></details>\n";
}

constexpr double kMostLinear = 10.0;  ///< times the noise: longer bars are logarithmic

/// One line of the picture of what is left, the noise's power as 1; from 0 on, or logarithmic from
/// a half on.
std::string Bar(const char* name, double ratio, double largest, const char* colour) {
  constexpr double kBegin = 0.5;
  const double width = largest <= kMostLinear ? ratio / std::max(largest, 1.0)
                                              : std::log(std::max(ratio, kBegin) / kBegin) /
                                                    std::log(largest / kBegin);
  return fmt::format(
      "<tr><td>{}</td><td><div class=bar><div style=\"width:{:.1f}%;background:{}\"></div></div>"
      "</td><td class=n>{:.2f}</td></tr>\n",
      name, 100.0 * std::clamp(width, 0.0, 1.0), colour, ratio);
}

/// Residuals of the models on validation data.
std::string Left(const DiagnosisReport& s) {
  const ReportFit& held = s.validation;
  const double nominal = held.nominal_over_noise;
  const double largest = std::max({nominal, held.calibrated_over_noise, held.extended_over_noise});
  std::string text =
      "<h2>What the model still gets wrong</h2><table>\n" +
      Bar("sensors' noise alone", 1.0, largest, "#2ca02c") +
      Bar("rig file", nominal, largest, "#888") +
      Bar("with its tolerances calibrated", held.calibrated_over_noise, largest, "#1f77b4");
  if (!s.causes.empty()) {
    text += Bar("with the cause", held.extended_over_noise, largest, "#d62728");
  }
  return text +
         "</table><p>Squared error of the one-step prediction, as a multiple of the sensors' "
         "noise, on data that were not fitted" +
         std::string(largest <= kMostLinear ? "" : " (bars logarithmic)") +
         ". Where calibration alone leaves "
         "little, the evidence (nat: logarithm of the odds) decides on a cause, not this.</p>\n";
}

std::string CalibrationTable(const DiagnosisReport& s) {
  std::string significant;
  std::string rest;
  for (const auto& v : s.calibrated) {
    (diagnosis::IsSignificant(v) ? significant : rest) += fmt::format(
        "<tr><td>{}</td><td class=k>{}</td><td>{}</td><td class=n>{}</td><td class=n>{}</td>"
        "<td class=n>{:.2g}</td><td class=n>{:.2g}</td></tr>\n",
        v.effect, Escaped(v.place), v.key, AtPhase(v.nominal, v.nominal_phase_rad),
        AtPhase(v.calibrated, v.phase_rad), v.deviation, v.tolerance);
  }
  if (significant.empty() && rest.empty()) return {};
  const std::string head =
      "<table><tr><th>effect</th><th>where</th><th>key</th><th>rig file</th><th>calibrated</th>"
      "<th>std</th><th>tolerance</th></tr>\n";
  const std::string first = significant.empty()
                                ? "<p>None is further than half its tolerance from the file.</p>\n"
                                : head + significant + "</table>\n";
  const auto& taken = s.taken_by_causes;
  return "<h2>Calibrated values</h2>\n<p>Numbers in which a healthy rig may differ "
         "from its file; std is their standard deviation given these data. All of them are in "
         "<code>diagnosis.json</code>, and in force in <code>calibrated_rig.yaml</code>." +
         (taken.empty() ? ""
                        : fmt::format(" Not among them, being a cause: {}.",
                                      Escaped(fmt::format("{}", fmt::join(taken, ", "))))) +
         "</p>\n" + first + "<details><summary>All others</summary>" + head + rest +
         "</table></details>\n";
}

/// Seconds, gain and limits in a sentence each.
std::string Summary(const DiagnosisReport& s) {
  const bool part = s.seconds_used < 0.99 * s.seconds_of_data;
  const std::string text =
      part ? fmt::format("From {:.1f} s of {:.1f} s in flight, spans spread over all records.",
                         s.seconds_used, s.seconds_of_data)
           : fmt::format("From {:.1f} s in flight.", s.seconds_of_data);
  return fmt::format("{} {}", text, GainSentence(s));
}

std::string ChannelTable(const DiagnosisReport& s) {
  std::string rows;
  for (const ReportFit::Channel& channel : s.validation.channels) {
    rows += fmt::format(
        "<tr><td>{}</td><td class=n>{:.2f}</td><td class=n>{:.2f}</td>"
        "<td class=n>{:.3f} ({:.3f} to {:.3f})</td></tr>\n",
        Escaped(channel.name), channel.nominal_percent, channel.extended_percent,
        channel.achieved.fraction, channel.achieved.low, channel.achieved.high);
  }
  return "<details><summary>Channel by channel</summary><table><tr><th>channel</th>"
         "<th>fit before, %</th><th>after, %</th><th>share of the achievable gain</th></tr>\n" +
         rows + "</table></details>\n";
}

std::string FitTable(const DiagnosisReport& s) {
  const auto row = [](const char* name, const ReportFit& g) {
    return fmt::format(
        "<tr><td>{}</td><td class=n>{:.2f}</td><td class=n>{:.2f}</td><td class=n>{:.2f}</td>"
        "<td class=n>{:.2f}</td><td class=n>{}</td></tr>\n",
        name, g.nominal_percent, g.calibrated_percent, g.extended_percent, g.ceiling_percent,
        g.meaningful ? fmt::format("{:.3f} ({:.3f} to {:.3f})", g.achieved.fraction, g.achieved.low,
                                   g.achieved.high)
                     : "the file fits to the noise");
  };
  return "<table><tr><th>fit, percent</th><th>nominal</th><th>calibrated</th><th>extended</th>"
         "<th>ceiling</th><th>share of the achievable gain</th></tr>\n" +
         row("fitted data", s.fitted) + row("validation data", s.validation) + "</table>\n";
}

std::string ParameterTable(const DiagnosisReport& s) {
  std::string rows;
  bool form = false;
  for (const auto& [p, places] : SharedParameters(s)) {
    form = form || p.form;
    const std::string range =
        p.low < p.high ? fmt::format("{:.5g} to {:.5g}", p.low, p.high) : std::string("-");
    rows += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td class=n>{:.5g}</td><td>{}</td><td>{}</td>"
        "<td>{}</td></tr>\n",
        p.effect, Escaped(places), p.key, p.value, Escaped(p.unit), range,
        p.low < p.high ? diagnosis::BracketName(p) : "");
  }
  if (rows.empty()) return {};
  std::string totals;
  for (const std::string& total : diagnosis::TotalSentences(s.parameters)) {
    totals += fmt::format("<p>{}.</p>\n", Escaped(total));
  }
  return "<h2>Parameters, as in a rig file</h2><table><tr><th>effect</th><th>where</th>"
         "<th>key</th><th>value</th><th>unit</th><th>from, to</th><th>which is</th></tr>\n" +
         rows + "</table>\n" + totals +
         (form ? "<p>Neighbouring forms: of a grid of laws that was tried; how well the value is "
                 "known they do not say.</p>\n"
               : "");
}

std::string RunsTable(const DiagnosisReport& s) {
  if (s.validation_runs.empty()) return {};
  std::string rows;
  const auto add = [&rows](const std::string& run, const char* quantity, const ReportRunFit& fit) {
    rows += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=n>{:.1f}</td><td class=n>{:.1f}</td>"
        "<td class=n><b>{:.1f}</b> ({})</td><td class=n>{:.1f}</td></tr>\n",
        Escaped(run), quantity, fit.nominal.value, fit.calibrated.value, fit.extended.value,
        IntervalText(fit), fit.ceiling_percent);
  };
  for (const diagnosis::ReportRun& run : s.validation_runs) {
    if (run.current) add(run.name, "current, free run", *run.current);
    add(run.name, "motion, one step", run.motion);
  }
  return "<h2>Runs that were not fitted: fit in percent</h2><table><tr><th>run</th><th></th>"
         "<th>rig file</th><th>calibrated</th><th>extended (5 to 95 %)</th><th>noise alone</th>"
         "</tr>\n" +
         rows + "</table>\n";
}

/// Above the verdict; empty when the records are in order.
std::string ErrorsOfRecords(const DiagnosisReport& s) {
  std::string html;
  for (const std::string& sentence : diagnosis::RecordErrorSentences(s.record_errors)) {
    html += fmt::format("<p class=\"verdict\"><b>{}</b></p>\n", Escaped(sentence));
  }
  if (!html.empty()) html += fmt::format("<p>{}</p>\n", diagnosis::kAsMended);
  return html;
}

/// "10^8" with its exponent raised, of text that is escaped.
std::string WithPowers(std::string text) {
  for (auto at = text.find("10^"); at != std::string::npos; at = text.find("10^", at + 3)) {
    const auto end = text.find_first_not_of("0123456789", at + 3);
    const std::string power = text.substr(at + 3, end == std::string::npos ? end : end - at - 3);
    text.replace(at, 3 + power.size(), "10<sup>" + power + "</sup>");
  }
  return text;
}

std::string Row(const char* name, const std::string& text) {
  return text.empty() ? "" : fmt::format("<tr><td class=k>{}</td><td>{}</td></tr>\n", name, text);
}

/// Headline, what it does, what to do, the rotor with the place.
std::string Advice(const DiagnosisReport& s) {
  const char* tone = s.severity == diagnosis::Severity::kSevere   ? " severe"
                     : s.severity == diagnosis::Severity::kMarked ? " marked"
                                                                  : "";
  return fmt::format("<p class=\"verdict{}\">{}</p>\n<table class=\"advice\">\n{}{}{}{}</table>\n",
                     tone, WithPowers(Escaped(s.headline)),
                     Row("What it does", Escaped(s.severity_sentence)),
                     Row("Action", Escaped(s.action)), Row("Compare", Escaped(HealthyProposal(s))),
                     Row("Further records", Escaped(FurtherRecords(s)))) +
         RotorSketch(s);
}

std::string Listed(const char* name, const std::vector<std::string>& files) {
  return files.empty() ? "" : fmt::format(" {}: {}.", name, fmt::join(files, ", "));
}

/// Date, version, files; empty where none is known.
std::string Origin(const DiagnosisReport& s) {
  const diagnosis::ReportOrigin& of = s.origin;
  std::string text;
  if (!of.date_utc.empty()) text += of.date_utc + ".";
  if (!of.program_version.empty()) text += fmt::format(" Levitas {}.", of.program_version);
  if (!of.rig_file.empty()) text += fmt::format(" Rig file: {}.", of.rig_file);
  text += Listed("Records", of.records) + Listed("Validation", of.validation) +
          Listed("Healthy", of.healthy);
  if (of.quick) text += " First answer (--quick).";
  return text.empty() ? "" : fmt::format("<p class=\"origin\">{}</p>\n", Escaped(text));
}

/// Of the rig files that were written; empty when they levitate.
std::string Levitation(const DiagnosisReport& s) {
  std::string html;
  for (const std::string& sentence : s.levitation.sentences) {
    html += fmt::format("<p><b>{}</b></p>\n", Escaped(sentence));
  }
  return html;
}

}  // namespace

std::string DiagnosisPage(const DiagnosisReport& s) {
  const std::string head = fmt::format(
      "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Diagnosis of "
      "{0}</title><style>{1}</style></head><body>\n<h1>Diagnosis of {0}</h1>\n",
      Escaped(s.rig_name), kStyle);
  const std::string detail = fmt::format(
      "<h2>In detail</h2>\n<p>{}</p>\n<p>{}</p>\n", WithPowers(Escaped(s.verdict_sentence)),
      Escaped(fmt::format("{} {}", Summary(s), s.healthy_sentence)));
  const std::string fit = fmt::format(
      "<h2>Fit</h2>\n{}<p>Nominal: the rig file. Calibrated: with the deviations of a healthy rig. "
      "Extended: with the causes. Ceiling: the sensors' noise alone. {}</p>\n<p>{}</p>\n",
      FitTable(s), FitRemarks(s), Escaped(ErrorSharesSentence(s)));
  return head + Origin(s) + ErrorsOfRecords(s) + Advice(s) + detail + Levitation(s) + Left(s) +
         Spectra(s) + ParameterTable(s) + CalibrationTable(s) + ForecastSection(s) +
         "<h2>Ranking, and why not the others</h2>\n" + Ranking(s) + fit + ChannelTable(s) +
         RunsTable(s) + "</body></html>\n";
}

}  // namespace levitas::cli
