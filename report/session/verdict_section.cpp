#include "report/session/verdict_section.hpp"

#include <fmt/format.h>

#include "common/rotational_speed.hpp"
#include "report/html/elements.hpp"
#include "report/html/table.hpp"

namespace levitas::report {
namespace {

using html::Kind;

std::string Orbits(const verdict::Verdict& verdict) {
  html::Table table({{"orbit"},
                     {"phase"},
                     {"largest radius, µm", Kind::kNumber},
                     {"objective, µm", Kind::kNumber},
                     {"of the clearance, %", Kind::kNumber},
                     {"zone"},
                     {"met"}},
                    "orbits");
  for (const auto& orbit : verdict.orbits) {
    table.Add({orbit.bearing, orbit.spinning ? "spinning" : "standing",
               fmt::format("{:.2f}", 1e6 * orbit.orbit.max_m),
               fmt::format("{:.2f}", 1e6 * orbit.objective_m),
               fmt::format("{:.1f}", 100.0 * orbit.clearance_share),
               std::string(analysis::Name(orbit.zone)), orbit.met ? "yes" : "NO"},
              orbit.met ? "" : "trip");
  }
  return table.empty() ? "" : table.Scrolling();
}

std::string MeasuredText(const verdict::Inputs& in, const std::string& channel, double speed) {
  if (!in.measured) return "-";
  const auto* axis = verdict::FindGraded(*in.measured, channel, speed);
  if (axis == nullptr) return "-";
  return fmt::format("{:.2f} ± {:.2f}, zone {}", axis->peak, axis->sigma,
                     analysis::Name(*axis->zone));
}

std::string Sensitivities(const verdict::Inputs& in) {
  html::Table table({{"speed, rpm", Kind::kNumber},
                     {"axis"},
                     {"largest |S|, computed", Kind::kNumber},
                     {"at, Hz", Kind::kNumber},
                     {"zone"},
                     {"measured"}},
                    "sensitivity");
  for (const auto& at : in.sensitivity) {
    for (std::size_t i = 0; i < at.axes.size() && i < in.rig.channels.size(); ++i) {
      const auto& axis = at.axes[i];
      const std::string& channel = in.rig.channels[i];
      table.Add({fmt::format("{:.0f}", RadPerSToRpm(at.speed_rad_per_s)), channel,
                 fmt::format("{:.3f}", axis.peak), fmt::format("{:.1f}", axis.frequency_hz),
                 axis.zone ? std::string(analysis::Name(*axis.zone)) : "unstable: no grade",
                 MeasuredText(in, channel, at.speed_rad_per_s)});
    }
  }
  return table.empty() ? "" : table.Scrolling();
}

}  // namespace

std::string VerdictSection(const std::optional<verdict::Verdict>& verdict) {
  if (!verdict) {
    return "<p class=verdict>Not judged: the record names no controller.</p>\n";
  }
  const bool good = verdict->outcome == verdict::Outcome::kAccepted;
  return html::Paragraph(verdict->sentence, good ? "verdict good" : "verdict") +
         html::List(verdict->objections, "objections") + html::List(verdict->warnings, "warnings") +
         "<div class=tables>\n" + Orbits(*verdict) + Sensitivities(verdict->inputs) + "</div>\n";
}

std::string CriticalSpeedSection(const std::optional<analysis::Campbell>& levitated) {
  if (!levitated) return {};
  const double top_rpm = RadPerSToRpm(levitated->speeds.back().speed_rad_per_s);
  std::string html = fmt::format(
      "<h2 id=critical>Critical speeds</h2>\n<p>Of the levitated rotor, computed from the run's "
      "files up to {:.0f} rpm: where an order of rotation meets a mode with a damping ratio below "
      "0.71. "
      "Amplification is 1/(2 damping); below {:.1f} API 617 calls a critical speed critically "
      "damped.</p>\n",
      top_rpm, analysis::kCriticallyDamped);
  if (levitated->crossings.empty()) return html + "<p>None.</p>\n";
  html::Table table({{"speed, rpm", Kind::kNumber},
                     {"frequency, Hz", Kind::kNumber},
                     {"damping ratio", Kind::kNumber},
                     {"amplification", Kind::kNumber},
                     {"whirl"},
                     {"excited by"}});
  for (const auto& crossing : levitated->crossings) {
    table.Add({fmt::format("{:.0f}", RadPerSToRpm(crossing.speed_rad_per_s)),
               fmt::format("{:.2f}", crossing.mode.frequency_hz),
               fmt::format("{:.4f}", crossing.mode.damping_ratio),
               fmt::format("{:.1f}", analysis::AmplificationFactor(crossing.mode)),
               std::string(analysis::WhirlName(crossing.mode)),
               levitated->orders[crossing.order].name});
  }
  return html + table.Scrolling();
}

}  // namespace levitas::report
