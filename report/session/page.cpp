#include "report/session/page.hpp"

#include <fmt/format.h>

#include <ctime>

#include "common/rotational_speed.hpp"
#include "report/session/page_parts.hpp"
#include "report/svg/escaped_text.hpp"
#include "verdict/report.hpp"

namespace levitas::report {
namespace {

using svg::Escaped;

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
  std::string html = PageStart(title);
  html += Judgement(input) + Identity(recording, input) + Gallery(input.pictures);
  if (input.verdict) {
    html += "<h2>Verdict</h2>\n<div class=scroll><pre>" + Escaped(verdict::Table(*input.verdict)) +
            "</pre></div>\n";
  }
  html += Events(recording) + Timing(recording, input);
  html += "<h2>Configuration</h2>\n" + Folded("rig", recording.header.rig_yaml) +
          Folded("controller", recording.header.controller_yaml) +
          Folded("scenario", recording.header.scenario_yaml);
  return html + PageEnd();
}

}  // namespace levitas::report
