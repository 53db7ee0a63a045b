#include "report/session/page.hpp"

#include <fmt/format.h>

#include <ctime>

#include "common/rotational_speed.hpp"
#include "report/session/page_parts.hpp"
#include "report/session/verdict_section.hpp"
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
  if (rows.empty()) return "<h2 id=events>Events</h2>\n<p>None.</p>\n";
  return "<h2 id=events>Events</h2>\n<div class=scroll><table>\n<tr><th class=n>time, "
         "s</th><th></th></tr>\n" +
         rows + "</table></div>\n";
}

std::string Timing(const Recording& r, const PageInput& input) {
  std::string html = fmt::format(
      "<h2 id=timing>Timing</h2>\n<p>{} cycles recorded; {} periods skipped, {} cycles without a "
      "new sensor "
      "frame.</p>\n",
      r.records, r.missed_deadlines, r.without_frame);
  if (input.durations.empty()) return html;
  html +=
      "<div class=scroll><table>\n<tr><th>duration</th><th class=n>count</th><th class=n>p50, "
      "µs</th><th class=n>p99, µs</th><th class=n>p99.9, µs</th><th class=n>largest, "
      "µs</th></tr>\n";
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

std::string Contents(const PageInput& input) {
  std::string links = "<nav>";
  if (input.levitated) links += "<a href=\"#critical\">Critical speeds</a> ";
  return links +
         "<a href=\"#pictures\">Pictures</a> <a href=\"#events\">Events</a> "
         "<a href=\"#timing\">Timing</a> <a href=\"#configuration\">Configuration</a></nav>\n";
}

}  // namespace

std::string Page(const Recording& recording, const PageInput& input) {
  const std::string title = recording.rig.name + ", " + Utc(recording.header.start_utc_ns);
  std::string html = PageStart(title);
  html += VerdictSection(input.verdict) + Contents(input) + Identity(recording, input) +
          CriticalSpeedSection(input.levitated) + Gallery(input.pictures);
  html += Events(recording) + Timing(recording, input);
  if (input.verdict) {
    html += Folded("The whole verdict, as amb run prints it", verdict::Table(*input.verdict));
  }
  html += "<h2 id=configuration>Configuration</h2>\n" + Folded("rig", recording.header.rig_yaml) +
          Folded("controller", recording.header.controller_yaml) +
          Folded("scenario", recording.header.scenario_yaml);
  return html + Cursor() + PageEnd();
}

}  // namespace levitas::report
