#include "report/session/verdict_section.hpp"

#include <fmt/format.h>

#include "common/rotational_speed.hpp"
#include "report/svg/escaped_text.hpp"

namespace levitas::report {
namespace {

using svg::Escaped;

std::string List(const std::vector<std::string>& sentences, const char* kind) {
  if (sentences.empty()) return {};
  std::string html = fmt::format("<ul class={}>\n", kind);
  for (const std::string& sentence : sentences) html += "<li>" + Escaped(sentence) + "</li>\n";
  return html + "</ul>\n";
}

std::string Orbits(const verdict::Verdict& verdict) {
  if (verdict.orbits.empty()) return {};
  std::string html =
      "<div class=scroll><table id=orbits>\n<tr><th>orbit</th><th>phase</th><th class=n>largest "
      "radius, µm</th><th class=n>objective, µm</th><th class=n>of the clearance, "
      "%</th><th>zone</th><th>met</th></tr>\n";
  for (const auto& orbit : verdict.orbits) {
    html += fmt::format(
        "<tr{}><td>{}</td><td>{}</td><td class=n>{:.2f}</td><td class=n>{:.2f}</td><td "
        "class=n>{:.1f}</td><td>{}</td><td>{}</td></tr>\n",
        orbit.met ? "" : " class=trip", Escaped(orbit.bearing),
        orbit.spinning ? "spinning" : "standing", 1e6 * orbit.orbit.max_m, 1e6 * orbit.objective_m,
        100.0 * orbit.clearance_share, analysis::Name(orbit.zone), orbit.met ? "yes" : "NO");
  }
  return html + "</table></div>\n";
}

std::string MeasuredText(const verdict::Inputs& in, const std::string& channel, double speed) {
  if (!in.measured) return "-";
  const auto* axis = verdict::FindGraded(*in.measured, channel, speed);
  if (axis == nullptr) return "-";
  return fmt::format("{:.2f} ± {:.2f}, zone {}", axis->peak, axis->sigma,
                     analysis::Name(*axis->zone));
}

std::string Sensitivities(const verdict::Inputs& in) {
  if (in.sensitivity.empty()) return {};
  std::string html =
      "<div class=scroll><table id=sensitivity>\n<tr><th class=n>speed, rpm</th><th>axis</th><th "
      "class=n>largest |S|, computed</th><th class=n>at, "
      "Hz</th><th>zone</th><th>measured</th></tr>\n";
  for (const auto& at : in.sensitivity) {
    for (std::size_t i = 0; i < at.axes.size() && i < in.rig.channels.size(); ++i) {
      const auto& axis = at.axes[i];
      html += fmt::format(
          "<tr><td class=n>{:.0f}</td><td>{}</td><td class=n>{:.3f}</td><td "
          "class=n>{:.1f}</td><td>{}</td><td>{}</td></tr>\n",
          RadPerSToRpm(at.speed_rad_per_s), Escaped(in.rig.channels[i]), axis.peak,
          axis.frequency_hz, axis.zone ? analysis::Name(*axis.zone) : "unstable: no grade",
          MeasuredText(in, in.rig.channels[i], at.speed_rad_per_s));
    }
  }
  return html + "</table></div>\n";
}

}  // namespace

std::string VerdictSection(const std::optional<verdict::Verdict>& verdict) {
  if (!verdict) {
    return "<p class=verdict>Not judged: the record names no controller.</p>\n";
  }
  const bool good = verdict->outcome == verdict::Outcome::kAccepted;
  return fmt::format("<p class='verdict{}'>{}</p>\n", good ? " good" : "",
                     Escaped(verdict->sentence)) +
         List(verdict->objections, "objections") + List(verdict->warnings, "warnings") +
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
  html +=
      "<div class=scroll><table>\n<tr><th class=n>speed, rpm</th><th class=n>frequency, "
      "Hz</th><th class=n>damping ratio</th><th class=n>amplification</th><th>whirl</th>"
      "<th>excited by</th></tr>\n";
  for (const auto& crossing : levitated->crossings) {
    html += fmt::format(
        "<tr><td class=n>{:.0f}</td><td class=n>{:.2f}</td><td class=n>{:.4f}</td><td "
        "class=n>{:.1f}</td><td>{}</td><td>{}</td></tr>\n",
        RadPerSToRpm(crossing.speed_rad_per_s), crossing.mode.frequency_hz,
        crossing.mode.damping_ratio, analysis::AmplificationFactor(crossing.mode),
        analysis::WhirlName(crossing.mode), Escaped(levitated->orders[crossing.order].name));
  }
  return html + "</table></div>\n";
}

}  // namespace levitas::report
