#include "report/diagnosis/diagnosis_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/report/sentences.hpp"
#include "report/diagnosis/diagnosis_text.hpp"
#include "report/diagnosis/forecast_section.hpp"
#include "report/diagnosis/rotor_sketch.hpp"
#include "report/html/elements.hpp"
#include "report/html/escaped_text.hpp"
#include "report/html/table.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report {
namespace {

using diagnosis::DiagnosisReport;
using diagnosis::ReportCandidate;
using diagnosis::ReportFit;
using diagnosis::ReportRunFit;
using diagnosis::ReportSentences;

constexpr const char* kStyle =
    "body{font:16px/1.5 sans-serif;max-width:64em;margin:2em auto;padding:0 1em;color:#222}"
    "h1{font-size:1.5em}.verdict{font-size:1.25em;padding:.8em "
    "1em;background:#eef4fb;border-left:6px "
    "solid #1f77b4}.verdict.severe{background:#fdecea;border-color:#d62728}.verdict.marked{"
    "background:#fff4e5;border-color:#e08a00}#advice td{vertical-align:top;border:0;padding:.25em "
    ".6em .25em 0}#advice "
    "td.k{font-weight:bold}.origin{color:#555;font-size:.9em}table{border-collapse:collapse}td,th{"
    "padding:.2em .6em;text-align:left;"
    "border-bottom:1px solid "
    "#ddd}td.n,th.n{text-align:right;white-space:nowrap}td.k{white-space:nowrap}svg{max-width:100%;"
    "margin:1em "
    "0}.bar{background:#eee;"
    "width:24em}"
    ".bar div{height:1em}.warning{font-weight:bold}summary{cursor:pointer;padding:.4em 0}";

using html::Escaped;
using html::Kind;
using html::Paragraph;
using html::Paragraphs;

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

/// Empty where the table is.
std::string FoldedTable(const char* title, const html::Table& table) {
  return table.empty() ? "" : html::FoldedMarkup(title, table.Html());
}

std::string Ranking(const DiagnosisReport& s, const ReportSentences& said) {
  constexpr std::size_t kShown = 8;
  html::Table first({{"what"},
                     {"effect"},
                     {"where"},
                     {"evidence, nat", Kind::kNumber},
                     {"why it is not the answer"}});
  html::Table rest = first;
  for (std::size_t i = 0; i < s.candidates.size(); ++i) {
    const ReportCandidate& c = s.candidates[i];
    (i < kShown ? first : rest)
        .Add({said.candidates[i], c.effect, c.place,
              std::isfinite(c.evidence_nat) ? fmt::format("{:.1f}", c.evidence_nat) : "-",
              c.reason});
  }
  return first.Html() + FoldedTable("All others that were ruled out", rest);
}

constexpr double kMostLinear = 10.0;  ///< times the noise: longer bars are logarithmic

/// The bar of a residual in the picture of what is left, the noise's power as 1; from 0 on, or
/// logarithmic from a half on.
std::string Bar(double ratio, double largest, const char* colour) {
  constexpr double kBegin = 0.5;
  const double width = largest <= kMostLinear ? ratio / std::max(largest, 1.0)
                                              : std::log(std::max(ratio, kBegin) / kBegin) /
                                                    std::log(largest / kBegin);
  return fmt::format("<div class=bar><div style=\"width:{:.1f}%;background:{}\"></div></div>",
                     100.0 * std::clamp(width, 0.0, 1.0), colour);
}

/// Residuals of the models on validation data.
std::string Left(const DiagnosisReport& s) {
  const ReportFit& held = s.validation;
  const double nominal = held.nominal_over_noise;
  const double largest = std::max({nominal, held.calibrated_over_noise, held.extended_over_noise});
  html::Table bars({{}, {"", Kind::kMarkup}, {"", Kind::kNumber}});
  const auto add = [&bars, largest](const char* name, double ratio, const char* colour) {
    bars.Add({name, Bar(ratio, largest, colour), fmt::format("{:.2f}", ratio)});
  };
  add("sensors' noise alone", 1.0, "#2ca02c");
  add("rig file", nominal, "#888");
  add("with its tolerances calibrated", held.calibrated_over_noise, "#1f77b4");
  if (!s.causes.empty()) add("with the cause", held.extended_over_noise, "#d62728");
  return "<h2>What the model still gets wrong</h2>\n" + bars.Html() +
         "<p>Squared error of the one-step prediction, as a multiple of the sensors' "
         "noise, on data that were not fitted" +
         std::string(largest <= kMostLinear ? "" : " (bars logarithmic)") +
         ". Where calibration alone leaves "
         "little, the evidence (nat: logarithm of the odds) decides on a cause, not this.</p>\n";
}

std::string CalibrationTable(const DiagnosisReport& s, const ReportSentences& said) {
  html::Table significant({{"effect"},
                           {"where", Kind::kKey},
                           {"key"},
                           {"rig file", Kind::kNumber},
                           {"calibrated", Kind::kNumber},
                           {"std", Kind::kNumber},
                           {"tolerance", Kind::kNumber}});
  html::Table rest = significant;
  for (std::size_t i = 0; i < s.calibrated.size(); ++i) {
    const diagnosis::CalibratedValue& v = s.calibrated[i];
    (said.significant[i] ? significant : rest)
        .Add({v.effect, v.place, v.key, AtPhase(v.nominal, v.nominal_phase_rad),
              AtPhase(v.calibrated, v.phase_rad), fmt::format("{:.2g}", v.deviation),
              fmt::format("{:.2g}", v.tolerance)});
  }
  if (significant.empty() && rest.empty()) return {};
  const auto& taken = s.taken_by_causes;
  const std::string causes =
      taken.empty() ? ""
                    : fmt::format(" Not among them, being a cause: {}.", fmt::join(taken, ", "));
  return "<h2>Calibrated values</h2>\n<p>Numbers in which a healthy rig may differ "
         "from its file; std is their standard deviation given these data. All of them are in "
         "<code>diagnosis.json</code>, and in force in <code>calibrated_rig.yaml</code>." +
         Escaped(causes) + "</p>\n" +
         (significant.empty() ? Paragraph("None is further than half its tolerance from the file.")
                              : significant.Html()) +
         FoldedTable("All others", rest);
}

/// Seconds, gain and limits in a sentence each.
std::string Summary(const DiagnosisReport& s, const ReportSentences& said) {
  const bool part = s.seconds_used < 0.99 * s.seconds_of_data;
  const std::string text =
      part ? fmt::format("From {:.1f} s of {:.1f} s in flight, spans spread over all records.",
                         s.seconds_used, s.seconds_of_data)
           : fmt::format("From {:.1f} s in flight.", s.seconds_of_data);
  return fmt::format("{} {}", text, said.gain);
}

std::string Percent(double value) { return fmt::format("{:.2f}", value); }

std::string WithInterval(const diagnosis::ReportShare& share) {
  return fmt::format("{:.3f} ({:.3f} to {:.3f})", share.fraction, share.low, share.high);
}

std::string ChannelTable(const DiagnosisReport& s) {
  html::Table table({{"channel"},
                     {"fit before, %", Kind::kNumber},
                     {"after, %", Kind::kNumber},
                     {"share of the achievable gain", Kind::kNumber}});
  for (const ReportFit::Channel& channel : s.validation.channels) {
    table.Add({channel.name, Percent(channel.nominal_percent), Percent(channel.extended_percent),
               WithInterval(channel.achieved)});
  }
  return html::FoldedMarkup("Channel by channel", table.Html());
}

std::string FitTable(const DiagnosisReport& s) {
  html::Table table({{"fit, percent"},
                     {"nominal", Kind::kNumber},
                     {"calibrated", Kind::kNumber},
                     {"extended", Kind::kNumber},
                     {"ceiling", Kind::kNumber},
                     {"share of the achievable gain", Kind::kNumber}});
  const auto add = [&table](const char* name, const ReportFit& g) {
    table.Add({name, Percent(g.nominal_percent), Percent(g.calibrated_percent),
               Percent(g.extended_percent), Percent(g.ceiling_percent),
               g.meaningful ? WithInterval(g.achieved) : "the file fits to the noise"});
  };
  add("fitted data", s.fitted);
  add("validation data", s.validation);
  return table.Html();
}

std::string ParameterTable(const DiagnosisReport& s, const ReportSentences& said) {
  html::Table table({{"effect"},
                     {"where"},
                     {"key"},
                     {"value", Kind::kNumber},
                     {"unit"},
                     {"from, to"},
                     {"which is"}});
  bool form = false;
  for (const auto& [p, places, bracket] : SharedParameters(s, said)) {
    form = form || p.form;
    const bool bracketed = p.low < p.high;
    table.Add({p.effect, places, p.key, fmt::format("{:.5g}", p.value), p.unit,
               bracketed ? fmt::format("{:.5g} to {:.5g}", p.low, p.high) : "-",
               bracketed ? bracket : ""});
  }
  if (table.empty()) return {};
  std::string totals;
  for (const std::string& total : said.totals) totals += Paragraph(total + ".");
  return "<h2>Parameters, as in a rig file</h2>\n" + table.Html() + totals +
         (form ? Paragraph("Neighbouring forms: of a grid of laws that was tried; how well the "
                           "value is known they do not say.")
               : "");
}

std::string RunsTable(const DiagnosisReport& s) {
  if (s.validation_runs.empty()) return {};
  html::Table table({{"run"},
                     {},
                     {"rig file", Kind::kNumber},
                     {"calibrated", Kind::kNumber},
                     {"extended (5 to 95 %)", Kind::kNumber},
                     {"noise alone", Kind::kNumber}});
  const auto add = [&table](const std::string& run, const char* quantity, const ReportRunFit& fit) {
    table.Add({run, quantity, fmt::format("{:.1f}", fit.nominal.value),
               fmt::format("{:.1f}", fit.calibrated.value),
               fmt::format("{:.1f} ({})", fit.extended.value, IntervalText(fit)),
               fmt::format("{:.1f}", fit.ceiling_percent)});
  };
  for (const diagnosis::ReportRun& run : s.validation_runs) {
    if (run.current) add(run.name, "current, free run", *run.current);
    add(run.name, "motion, one step", run.motion);
  }
  return "<h2>Runs that were not fitted: fit in percent</h2>\n" + table.Html();
}

/// Above the verdict; empty when the records are in order.
std::string ErrorsOfRecords(const ReportSentences& said) {
  const std::string html = Paragraphs(said.record_errors, "verdict warning");
  return html.empty() ? "" : html + Paragraph(diagnosis::kAsMended);
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

/// Headline, what it does, what to do, the rotor with the place.
std::string Advice(const DiagnosisReport& s, const ReportSentences& said) {
  const char* tone = s.severity == diagnosis::Severity::kSevere   ? " severe"
                     : s.severity == diagnosis::Severity::kMarked ? " marked"
                                                                  : "";
  html::Table advice({{"", Kind::kKey}, {}}, "advice");
  for (const auto& [name, text] : {std::pair{"What it does", s.severity_sentence},
                                   {"Action", s.action},
                                   {"Compare", HealthyProposalText(s)},
                                   {"Further records", FurtherRecords(s)}}) {
    if (!text.empty()) advice.Add({name, text});
  }
  return fmt::format("<p class=\"verdict{}\">{}</p>\n", tone, WithPowers(Escaped(s.headline))) +
         advice.Html() + RotorSketch(s, said.marks);
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
  return Paragraph(text, "origin");
}

}  // namespace

std::string DiagnosisPage(const DiagnosisReport& s) {
  const ReportSentences said = diagnosis::SentencesOf(s);
  const std::string head = fmt::format(
      "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Diagnosis of "
      "{0}</title><style>{1}</style></head><body>\n<h1>Diagnosis of {0}</h1>\n",
      Escaped(s.rig_name), kStyle);
  const std::string detail =
      fmt::format("<h2>In detail</h2>\n<p>{}</p>\n", WithPowers(Escaped(s.verdict_sentence))) +
      Paragraph(fmt::format("{} {}", Summary(s, said), s.healthy_sentence));
  const std::string fit =
      "<h2>Fit</h2>\n" + FitTable(s) +
      Paragraph(
          "Nominal: the rig file. Calibrated: with the deviations of a healthy rig. Extended: with "
          "the causes. Ceiling: the sensors' noise alone. " +
          FitRemarks(s)) +
      Paragraph(ErrorSharesSentence(s));
  return head + Origin(s) + ErrorsOfRecords(said) + Advice(s, said) + detail +
         Paragraphs(s.levitation.sentences, "warning") + Left(s) + Spectra(s) +
         ParameterTable(s, said) + CalibrationTable(s, said) + ForecastSection(s, said) +
         "<h2>Ranking, and why not the others</h2>\n" + Ranking(s, said) + fit + ChannelTable(s) +
         RunsTable(s) + "</body></html>\n";
}

}  // namespace levitas::report
