#include "cli/diagnosis_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/words.hpp"
#include "report/svg/figure.hpp"

namespace levitas::cli {
namespace {

using diagnosis::Candidate;
using diagnosis::SessionAnswer;

constexpr const char* kStyle =
    "body{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222}"
    "h1{font-size:1.5em}.verdict{font-size:1.25em;padding:.8em "
    "1em;background:#eef4fb;border-left:6px "
    "solid #1f77b4}table{border-collapse:collapse}td,th{padding:.2em .8em;text-align:left;"
    "border-bottom:1px solid #ddd}td.n{text-align:right}.bar{background:#eee;width:24em}"
    ".bar div{height:1em}summary{cursor:pointer;padding:.4em 0}";

std::string Escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string Spectra(const SessionAnswer& s) {
  svg::Panel panel;
  panel.title = "What the model leaves in " + s.view->numbers.channels[s.shown_channel];
  panel.x_label = "Hz";
  panel.y_label = "power / sensor noise";
  panel.x_scale = svg::Scale::kLogarithmic;
  panel.y_scale = svg::Scale::kLogarithmic;
  svg::Series before{.name = "nominal model"};
  svg::Series after{.name = "extended model"};
  after.colour = "#d62728";
  for (std::size_t i = 1; i < s.ratio_before.size() && i < s.ratio_after.size(); ++i) {
    before.x.push_back(static_cast<double>(i) * s.line_spacing_hz);
    before.y.push_back(s.ratio_before[i]);
    after.x.push_back(before.x.back());
    after.y.push_back(s.ratio_after[i]);
  }
  panel.series = {before, after};
  svg::Figure figure;
  figure.panel_width = 760;
  figure.panels = {panel};
  return svg::Draw(figure);
}

/// Why an effect is not the answer.
std::string Why(const SessionAnswer& s, const Candidate& candidate) {
  const auto& a = s.answer;
  for (const auto& cause : a.causes) {
    if (cause.effect == candidate.effect) return "named";
  }
  const bool tied = std::find(a.also_possible.begin(), a.also_possible.end(), candidate.effect) !=
                    a.also_possible.end();
  if (tied) return "cannot be told from the cause with these data";
  if (!std::isfinite(candidate.score))
    return "would have to be negative, or cannot act in these data";
  if (candidate.score < diagnosis::kDecisive) {
    return candidate.score < 0.0 ? "explains less than its freedom costs"
                                 : "too little to be decisive";
  }
  return fmt::format("explains {:.0f} nat less than the cause",
                     a.candidates.front().score - candidate.score);
}

std::string Ranking(const SessionAnswer& s) {
  constexpr std::size_t kShown = 8;
  std::string rows;
  std::string rest;
  for (std::size_t i = 0; i < s.answer.candidates.size(); ++i) {
    const Candidate& c = s.answer.candidates[i];
    const std::string score = std::isfinite(c.score) ? fmt::format("{:.1f}", c.score) : "-";
    (i < kShown ? rows : rest) +=
        fmt::format("<tr><td>{}</td><td>{}</td><td class=n>{}</td><td>{}</td></tr>\n", c.effect,
                    Escaped(c.place), score, Why(s, c));
  }
  const std::string head =
      "<table><tr><th>effect</th><th>where</th><th>evidence, nat</th><th></th></tr>\n";
  return head + rows + "</table>\n<details><summary>All others that were ruled out</summary>" +
         head + rest + "</table></details>\n";
}

/// One line of the picture of what is left beyond the noise.
std::string Bar(const char* name, double left, const char* colour) {
  const double percent = 100.0 * std::max(left, 0.0);
  return fmt::format(
      "<tr><td>{}</td><td><div class=bar><div style=\"width:{:.1f}%;background:{}\"></div></div>"
      "</td><td class=n>{:.1f} %</td></tr>\n",
      name, std::min(percent, 100.0), colour, percent);
}

/// Squared error beyond the noise that a fit leaves, as a share of what the nominal model leaves.
double Remaining(const diagnosis::Gain& gain, double fit_percent) {
  const auto square = [](double percent) {
    return (1.0 - 0.01 * percent) * (1.0 - 0.01 * percent);
  };
  const double noise = square(gain.ceiling_percent);
  const double nominal = square(gain.nominal_percent) - noise;
  return nominal > 0.0 ? std::clamp((square(fit_percent) - noise) / nominal, 0.0, 1.0) : 0.0;
}

/// What the models leave of the nominal model's excess over the noise, on data kept back.
std::string Left(const SessionAnswer& s) {
  return "<h2>What the model still gets wrong</h2><table>\n" + Bar("rig file", 1.0, "#888") +
         Bar("with its tolerances calibrated", Remaining(s.held_out, s.held_out.calibrated_percent),
             "#1f77b4") +
         Bar("with the cause", Remaining(s.held_out, s.held_out.extended_percent), "#d62728") +
         "</table><p>Squared error beyond the sensors' noise, on data that were not fitted. Where "
         "calibration alone leaves little, a cause is told by the evidence (nat: logarithm of the "
         "odds), not by this.</p>\n";
}

std::string ChannelTable(const SessionAnswer& s) {
  std::string rows;
  for (std::size_t i = 0; i < s.held_out.channel.size(); ++i) {
    const auto& g = s.held_out.channel[i];
    rows += fmt::format(
        "<tr><td>{}</td><td class=n>{:.2f}</td><td class=n>{:.2f}</td>"
        "<td class=n>{:.3f} ({:.3f} to {:.3f})</td></tr>\n",
        Escaped(s.view->numbers.channels[i]), s.held_out.channel_nominal_percent[i],
        s.held_out.channel_extended_percent[i], g.value, g.low, g.high);
  }
  return "<details><summary>Channel by channel</summary><table><tr><th>channel</th>"
         "<th>fit before, %</th><th>after, %</th><th>share of the achievable gain</th></tr>\n" +
         rows + "</table></details>\n";
}

std::string FitTable(const SessionAnswer& s) {
  const auto row = [](const char* name, const diagnosis::Gain& g) {
    return fmt::format(
        "<tr><td>{}</td><td class=n>{:.2f}</td><td class=n>{:.2f}</td><td class=n>{:.2f}</td>"
        "<td class=n>{:.2f}</td><td class=n>{:.3f} ({:.3f} to {:.3f})</td></tr>\n",
        name, g.nominal_percent, g.calibrated_percent, g.extended_percent, g.ceiling_percent,
        g.achieved.value, g.achieved.low, g.achieved.high);
  };
  return "<table><tr><th>fit, percent</th><th>nominal</th><th>calibrated</th><th>extended</th>"
         "<th>ceiling</th><th>share of the achievable gain</th></tr>\n" +
         row("data used", s.fitted) + row("data kept back", s.held_out) + "</table>\n";
}

std::string ParameterTable(const SessionAnswer& s) {
  std::string rows;
  for (const auto& p : diagnosis::Parameters(s)) {
    rows += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=n>{:.5g}</td><td>{:.5g} to {:.5g}</td>"
        "<td>{}</td></tr>\n",
        p.effect, Escaped(p.name), p.value, p.low, p.high, p.unit);
  }
  if (rows.empty()) return {};
  return "<h2>Parameters</h2><table><tr><th>effect</th><th>parameter</th><th>value</th>"
         "<th>5 to 95 %</th><th>unit</th></tr>\n" +
         rows + "</table>\n";
}

}  // namespace

std::string DiagnosisPage(const SessionAnswer& s, const std::string& more) {
  return fmt::format(
      "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Diagnosis of "
      "{0}</title>"
      "<style>{1}</style></head><body>\n<h1>Diagnosis of {0}</h1>\n<p class=\"verdict\">{2}</p>\n"
      "<p>From {3:.1f} s of data. Of what a better model could gain on data kept back, this one "
      "gains {4:.0f} % ({5:.0f} to {6:.0f} %). <b>Next:</b> {11}.</p>\n{14}{12}{8}{7}\n"
      "<h2>Ranking, and why not the others</h2>\n{10}{9}{13}</body></html>\n",
      Escaped(s.view->numbers.name), kStyle, Escaped(diagnosis::VerdictSentence(s)),
      s.seconds_of_data, 100.0 * s.held_out.achieved.value, 100.0 * s.held_out.achieved.low,
      100.0 * s.held_out.achieved.high, Spectra(s), ParameterTable(s),
      "<h2>Fit</h2>\n" + FitTable(s), Ranking(s), Escaped(diagnosis::NextExperiment(s)), Left(s),
      ChannelTable(s), more);
}

}  // namespace levitas::cli
