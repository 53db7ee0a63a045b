#include "report/session/page.hpp"

#include <fmt/format.h>

#include <ctime>

#include "common/rotational_speed.hpp"
#include "report/svg/escaped_text.hpp"
#include "verdict/report.hpp"

namespace levitas::report {
namespace {

constexpr const char* kStyle = R"css(
body{font:16px/1.5 sans-serif;max-width:76em;margin:0 auto;padding:1em;color:#1f2430;background:#fff}
h1{font-size:1.5em;margin:.2em 0}h2{font-size:1.2em;margin:1.6em 0 .4em}
.verdict{padding:.7em 1em;margin:1em 0;border-left:8px solid #d55e00;background:#fbefe6;
font-size:1.1em}.verdict.good{border-color:#0072b2;background:#e8f2f9}
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,28em),1fr));gap:1em}
figure{margin:0;border:1px solid #d9dee6;border-radius:4px;padding:.4em}
figure img{display:block;width:100%;height:auto}
figcaption{color:#4b5363;font-size:.85em;padding:.3em .4em}
.scroll{overflow-x:auto}pre{font-size:.8em;line-height:1.35;margin:.3em 0}
table{border-collapse:collapse}td,th{padding:.15em .8em .15em 0;text-align:left;
vertical-align:top;border-bottom:1px solid #e3e7ee}td{overflow-wrap:anywhere}td.n,th.n{text-align:right;
font-variant-numeric:tabular-nums;white-space:nowrap}tr.trip{font-weight:bold}
summary{cursor:pointer;font-weight:bold;padding:.3em 0}
@media print{figure{break-inside:avoid}details{display:none}}
)css";

using svg::Escaped;

/// A picture as an address that holds it. As an image of its own its names collide with no other's.
std::string DataAddress(const std::string& svg) {
  std::string address = "data:image/svg+xml,";
  address.reserve(svg.size() + svg.size() / 8);
  for (const char c : svg) {
    if (c == '%' || c == '#' || c == '&' || c == '"' || c == '<' || c == '>' || c == '\n') {
      address += fmt::format("%{:02X}", static_cast<unsigned>(c));
    } else {
      address += c;
    }
  }
  return address;
}

std::string Utc(std::int64_t time_ns) {
  const auto seconds = static_cast<std::time_t>(time_ns / 1'000'000'000);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02} UTC", utc.tm_year + 1900, utc.tm_mon + 1,
                     utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

std::string Row(const std::string& name, const std::string& value) {
  if (value.empty()) return {};
  return fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", Escaped(name), Escaped(value));
}

std::string Identity(const Recording& r, const PageInput& input) {
  const session::SessionHeader& header = r.header;
  const double seconds = r.TimeOf(r.size() - 1) + r.rig.period_s();
  return "<div class=scroll><table>\n" + Row("session", input.session_path) +
         Row("recorded", Utc(header.start_utc_ns)) +
         Row("run", fmt::format("{:.2f} s at {:g} kHz, {}, seed {}, {}", seconds,
                                1e-3 / r.rig.period_s(), header.pace, header.seed, header.source)) +
         Row("top speed", fmt::format("{:.0f} rpm", RadPerSToRpm(r.top_speed_rad_per_s))) +
         Row("machine", header.machine) + Row("program", header.program_version) +
         Row("excerpt of", header.excerpt_of) + Row("damage", r.damage) + "</table></div>\n";
}

std::string Judgement(const PageInput& input) {
  if (!input.verdict) {
    return "<p class=verdict>Not judged: the record names no controller.</p>\n";
  }
  const bool good = input.verdict->outcome == verdict::Outcome::kAccepted;
  return fmt::format("<p class='verdict{}'>{}</p>\n", good ? " good" : "",
                     Escaped(input.verdict->sentence));
}

std::string Gallery(const PageInput& input) {
  std::string html = "<h2>Pictures</h2>\n<div class=pictures>\n";
  for (const NamedPicture& picture : input.pictures) {
    html += fmt::format(
        "<figure id=\"{}\"><img alt=\"{}\" src=\"{}\"><figcaption>{}</figcaption></figure>\n",
        Escaped(picture.name), Escaped(picture.caption), DataAddress(svg::Draw(picture.figure)),
        Escaped(picture.caption));
  }
  return html + "</div>\n";
}

std::string Events(const Recording& r) {
  std::string rows;
  for (const session::Event& event : r.events) {
    const double time_s =
        (static_cast<double>(event.cycle) - static_cast<double>(r.cycle.front())) *
        r.rig.period_s();
    const bool trip = event.severity == session::Event::Severity::kTrip;
    rows += fmt::format("<tr{}><td class=n>{:.3f}</td><td>{}</td></tr>\n",
                        trip ? " class=trip" : "", time_s, Escaped(event.text));
  }
  if (rows.empty()) return "<h2>Events</h2>\n<p>None.</p>\n";
  return "<h2>Events</h2>\n<div class=scroll><table>\n<tr><th class=n>time, "
         "s</th><th></th></tr>\n" +
         rows + "</table></div>\n";
}

std::string Timing(const Recording& r, const PageInput& input) {
  std::string html = fmt::format(
      "<h2>Timing</h2>\n<p>{} cycles recorded; {} periods skipped, {} cycles without a new sensor "
      "frame.</p>\n",
      r.records, r.missed_deadlines, r.without_frame);
  if (input.durations.empty()) return html;
  html +=
      "<div class=scroll><table>\n<tr><th>duration</th><th class=n>count</th><th class=n>p50, "
      "us</th><th class=n>p99, us</th><th class=n>p99.9, us</th><th class=n>largest, "
      "us</th></tr>\n";
  for (const verdict::DurationFigures& d : input.durations) {
    html += fmt::format(
        "<tr><td>{}</td><td class=n>{}</td><td class=n>{:.2f}</td><td class=n>{:.2f}</td><td "
        "class=n>{:.2f}</td><td class=n>{:.2f}</td></tr>\n",
        Escaped(d.name), d.count, d.p50_ns * 1e-3, d.p99_ns * 1e-3, d.p999_ns * 1e-3,
        d.max_ns * 1e-3);
  }
  return html + "</table></div>\n";
}

std::string Folded(const std::string& title, const std::string& text) {
  if (text.empty()) return {};
  return fmt::format(
      "<details><summary>{}</summary><div class=scroll><pre>{}</pre></div></details>\n",
      Escaped(title), Escaped(text));
}

}  // namespace

std::string Page(const Recording& recording, const PageInput& input) {
  const std::string title = recording.rig.name + ", " + Utc(recording.header.start_utc_ns);
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=en><head><meta charset=utf-8>\n<meta name=viewport "
      "content='width=device-width,initial-scale=1'>\n<title>{0}</title>\n<style>{1}</style></head>"
      "\n<body>\n<h1>{0}</h1>\n",
      Escaped(title), kStyle);
  html += Judgement(input) + Identity(recording, input) + Gallery(input);
  if (input.verdict) {
    html += "<h2>Verdict</h2>\n<div class=scroll><pre>" + Escaped(verdict::Table(*input.verdict)) +
            "</pre></div>\n";
  }
  html += Events(recording) + Timing(recording, input);
  html += "<h2>Configuration</h2>\n" + Folded("rig", recording.header.rig_yaml) +
          Folded("controller", recording.header.controller_yaml) +
          Folded("scenario", recording.header.scenario_yaml);
  return html + "</body></html>\n";
}

}  // namespace levitas::report
