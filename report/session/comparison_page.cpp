#include "report/session/comparison_page.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/rotational_speed.hpp"
#include "report/html/elements.hpp"
#include "report/html/escaped_text.hpp"
#include "report/html/table.hpp"
#include "report/session/page_parts.hpp"

namespace levitas::report {
namespace {

/// What the circle of the objective says of each record, by the largest radius of all its speeds.
std::string AgainstCircle(const Comparison& c, double circle_um) {
  std::string html;
  for (const ComparedRecord& record : c.records) {
    double largest_um = 0.0;
    double at_rpm = 0.0;
    for (std::size_t i = 0; i < record.speeds.size(); ++i) {
      if (!record.speeds[i]) continue;
      for (const double radius_m : record.speeds[i]->found.largest_radius_m) {
        if (kUm * radius_m <= largest_um) continue;
        largest_um = kUm * radius_m;
        at_rpm = RadPerSToRpm(c.speeds_rad_per_s[i]);
      }
    }
    const bool inside = largest_um <= circle_um;
    html += html::Paragraph(
        fmt::format("{}: largest radius {:.1f} µm at {:.0f} rpm, {} the circle of {:g} µm",
                    record.label, largest_um, at_rpm, inside ? "inside" : "outside", circle_um),
        inside ? "verdict good" : "verdict");
  }
  return html;
}

std::string WhatIsCompared(const Comparison& c) {
  html::Table table({{"record"}, {"file"}, {"rig"}, {"controller"}, {"damage"}});
  for (const ComparedRecord& record : c.records) {
    table.Add({record.label, record.path, record.rig, record.controller, record.damage});
  }
  return table.Scrolling();
}

}  // namespace

std::string ComparisonPage(const Comparison& comparison, const std::string& table,
                           double circle_um) {
  std::string html = PageStart("Recorded runs side by side");
  if (circle_um > 0.0) html += AgainstCircle(comparison, circle_um);
  html += WhatIsCompared(comparison) + Gallery(ComparisonPictures(comparison, circle_um));
  html += "<h2>Synchronous amplitudes</h2>\n<div class=scroll><pre>" + html::Escaped(table) +
          "</pre></div>\n";
  return html + PageEnd();
}

}  // namespace levitas::report
