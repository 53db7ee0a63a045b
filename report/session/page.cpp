#include "report/session/page.hpp"

#include <fmt/format.h>

#include <ctime>

#include "common/rotational_speed.hpp"
#include "report/html/elements.hpp"
#include "report/html/table.hpp"
#include "report/session/page_parts.hpp"
#include "report/session/verdict_section.hpp"
#include "verdict/report.hpp"

namespace levitas::report {
namespace {

using html::Folded;
using html::Kind;

std::string Utc(std::int64_t time_ns) {
  const auto seconds = static_cast<std::time_t>(time_ns / 1'000'000'000);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02} UTC", utc.tm_year + 1900, utc.tm_mon + 1,
                     utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

std::string Identity(const Recording& r, const PageInput& input) {
  const session::SessionHeader& header = r.header;
  const double seconds = r.TimeOf(r.size() - 1) + r.rig.period_s();
  html::Table table({{"", Kind::kKey}, {}});
  const auto add = [&table](const char* name, const std::string& value) {
    if (!value.empty()) table.Add({name, value});
  };
  add("session", input.session_path);
  add("recorded", Utc(header.start_utc_ns));
  add("run", fmt::format("{:.2f} s at {:g} kHz, {}, seed {}, {}", seconds, 1e-3 / r.rig.period_s(),
                         header.pace, header.seed, header.source));
  add("top speed", fmt::format("{:.0f} rpm", RadPerSToRpm(r.top_speed_rad_per_s)));
  add("machine", header.machine);
  add("program", header.program_version);
  add("excerpt of", header.excerpt_of);
  add("damage", r.damage);
  return table.Scrolling();
}

std::string Events(const Recording& r) {
  html::Table table({{"time, s", Kind::kNumber}, {}});
  for (const session::Event& event : r.events) {
    const double time_s =
        (static_cast<double>(event.cycle) - static_cast<double>(r.cycle.front())) *
        r.rig.period_s();
    const bool trip = event.severity == session::Event::Severity::kTrip;
    table.Add({fmt::format("{:.3f}", time_s), event.text}, trip ? "trip" : "");
  }
  return "<h2 id=events>Events</h2>\n" + (table.empty() ? "<p>None.</p>\n" : table.Scrolling());
}

std::string Timing(const Recording& r, const PageInput& input) {
  const std::string html = fmt::format(
      "<h2 id=timing>Timing</h2>\n<p>{} cycles recorded; {} periods skipped, {} cycles without a "
      "new sensor "
      "frame.</p>\n",
      r.records, r.missed_deadlines, r.without_frame);
  html::Table table({{"duration"},
                     {"count", Kind::kNumber},
                     {"p50, µs", Kind::kNumber},
                     {"p99, µs", Kind::kNumber},
                     {"p99.9, µs", Kind::kNumber},
                     {"largest, µs", Kind::kNumber}});
  const auto us = [](auto nanoseconds) {
    return fmt::format("{:.2f}", static_cast<double>(nanoseconds) * 1e-3);
  };
  for (const verdict::DurationFigures& d : input.durations) {
    table.Add({d.name, fmt::format("{}", d.count), us(d.p50_ns), us(d.p99_ns), us(d.p999_ns),
               us(d.max_ns)});
  }
  return table.empty() ? html : html + table.Scrolling();
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
