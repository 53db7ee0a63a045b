#include "cli/commands/trend_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/rotational_speed.hpp"
#include "report/text/text_table.hpp"
#include "rt/say.hpp"

namespace levitas::cli {
namespace {

using analysis::ShaftCondition;
using analysis::ShaftTrend;

constexpr double kClearlyMore = 0.2;  // of what turns once, by which a pulse grows on its own

double NoiseOf(const ShaftCondition& of) { return std::sqrt(of.energy_m2.deviation); }

std::string ShaftTable(const FollowedSessions& f, std::size_t shaft) {
  report::TextTable table;
  table.Add({"session", "amplitude", "of noise", "rise", "FM4", "+-", "once a turn", "mesh"});
  for (std::size_t i = 0; i < f.sessions.size(); ++i) {
    const analysis::GearCondition& at = f.sessions[i].condition;
    std::vector<std::string> row{rt::OneLine(f.sessions[i].label)};
    if (shaft >= at.shafts.size()) {
      row.emplace_back("-");
      table.Add(std::move(row));
      continue;
    }
    const ShaftCondition& of = at.shafts[shaft];
    row.push_back(fmt::format("{:.4f}", 1e6 * of.Amplitude()));
    row.push_back(fmt::format("{:.4f}", 1e6 * NoiseOf(of)));
    row.push_back(f.trends.empty() ? "-" : fmt::format("{:+.1f}", f.trends[shaft].rise[i]));
    row.push_back(fmt::format("{:.2f}", of.fm4.value));
    row.push_back(fmt::format("{:.2f}", of.fm4.deviation));
    row.push_back(fmt::format("{:.3f}", 1e6 * of.once_m));
    row.push_back(fmt::format("{:.3f}", 1e6 * at.mesh_m));
    table.Add(std::move(row));
  }
  return table.Text();
}

/// "session", "3 sessions": behind "the first".
std::string Sessions(std::size_t count) {
  return count == 1 ? "session" : fmt::format("{} sessions", count);
}

std::string TrendOf(const ShaftTrend& trend) {
  const analysis::Slope& slope = trend.amplitude_m;
  const std::string value = fmt::format("{:+.4f} um per session", 1e6 * slope.value);
  if (!(slope.coverage > 0.0)) return value;  // two sessions have no interval
  return value + fmt::format(" ({:+.4f} to {:+.4f}, {:.0f} %)", 1e6 * slope.low, 1e6 * slope.high,
                             100.0 * slope.coverage);
}

std::string WheelsOf(const FollowedSessions& f, std::size_t shaft) {
  for (const ShaftTrend& trend : f.trends) {
    if (trend.shaft == shaft) return trend.wheels;
  }
  return "other wheel";
}

std::string VerdictOf(const FollowedSessions& f, const ShaftTrend& trend) {
  std::string text;
  if (trend.risen) {
    text = fmt::format(
        "RISING: {}, {:.1f} deviations above the first {}, in {:.0f} lines; {}. A pulse "
        "once a turn, as a cracked or spalled tooth makes: look at the teeth of this wheel",
        trend.wheels, trend.rise.back(), Sessions(f.rule.baseline), trend.lines, TrendOf(trend));
    if (trend.or_else) {
      text += fmt::format(
          "; or of the {}: without a load on the teeth the two look alike. Run it under a load",
          WheelsOf(f, *trend.or_else));
    }
    if (std::abs(trend.once_ratio - 1.0) > kClearlyMore) {
      text += fmt::format(
          ". What turns once a turn is {:.2f} times what it was: a pulse that was there grows with "
          "it",
          trend.once_ratio);
    }
    return text + "\n";
  }
  text = fmt::format("no rise: {}, {:+.1f} deviations; {}", trend.wheels, trend.rise.back(),
                     TrendOf(trend));
  if (trend.explained_by) {
    text = fmt::format("not told: {}. The pulse of the wheel that rises makes its lines, too",
                       trend.wheels);
  } else if (trend.rise.back() >= f.rule.rise) {
    text += fmt::format(". It lies in {:.1f} lines, and a pulse in {:.0f} or more: another tone",
                        trend.lines, f.rule.least_lines);
  }
  return text + "\n";
}

nlohmann::ordered_json ShaftJson(const ShaftCondition& of) {
  return {{"wheels", of.wheels}, {"amplitude_m", of.Amplitude()},     {"noise_m", NoiseOf(of)},
          {"fm4", of.fm4.value}, {"fm4_deviation", of.fm4.deviation}, {"once_m", of.once_m}};
}

}  // namespace

std::string TrendText(const FollowedSessions& f) {
  std::string text =
      fmt::format("rig {}, {} sessions at {:.0f} rpm; amplitudes [um], rise in deviations\n",
                  rt::OneLine(f.rig), f.sessions.size(), RadPerSToRpm(f.speed_rad_per_s));
  const auto& first = f.sessions.front().condition;
  for (std::size_t s = 0; s < first.shafts.size(); ++s) {
    text += fmt::format("\n{}: multiples of its rotation, without teeth, 1x, 2x and 3x\n{}",
                        first.shafts[s].wheels, ShaftTable(f, s));
  }
  text += "\n";
  for (const std::string& what : f.not_known) text += fmt::format("not known: {}\n", what);
  if (!f.reasons.empty()) {
    text += "NOT COMPARABLE, so that no rise is said:\n";
    for (const std::string& reason : f.reasons) text += fmt::format("  {}\n", reason);
    return text;
  }
  if (f.trends.empty()) {
    return text + fmt::format(
                      "{} sessions say no trend: the first {} are what the later ones are "
                      "held against\n",
                      f.sessions.size(), f.rule.baseline);
  }
  for (const ShaftTrend& trend : f.trends) text += VerdictOf(f, trend);
  return text;
}

nlohmann::ordered_json TrendJson(const FollowedSessions& f) {
  auto sessions = nlohmann::ordered_json::array();
  for (const FollowedSession& session : f.sessions) {
    auto shafts = nlohmann::ordered_json::array();
    for (const ShaftCondition& of : session.condition.shafts) shafts.push_back(ShaftJson(of));
    sessions.push_back({{"session", session.path},
                        {"speed_rpm", RadPerSToRpm(session.condition.speed_rad_per_s)},
                        {"repeats", session.condition.repeats},
                        {"mesh_m", session.condition.mesh_m},
                        {"shafts", std::move(shafts)}});
  }
  auto trends = nlohmann::ordered_json::array();
  for (const ShaftTrend& trend : f.trends) {
    nlohmann::ordered_json one{{"wheels", trend.wheels},
                               {"risen", trend.risen},
                               {"rise_deviations", trend.rise},
                               {"slope_per_session_m", trend.amplitude_m.value},
                               {"slope_low_per_session_m", trend.amplitude_m.low},
                               {"slope_high_per_session_m", trend.amplitude_m.high},
                               {"coverage", trend.amplitude_m.coverage},
                               {"lines", trend.lines},
                               {"once_ratio", trend.once_ratio}};
    one["explained_by_other_wheel"] = trend.explained_by.has_value();
    one["or_other_wheel"] = trend.or_else.has_value();
    trends.push_back(std::move(one));
  }
  return {{"rig", f.rig},
          {"speed_rpm", RadPerSToRpm(f.speed_rad_per_s)},
          {"comparable", f.reasons.empty()},
          {"reasons", f.reasons},
          {"not_known", f.not_known},
          {"baseline", f.rule.baseline},
          {"sessions", std::move(sessions)},
          {"trends", std::move(trends)}};
}

svg::Figure TrendFigure(const FollowedSessions& f) {
  svg::Figure figure;
  figure.title = fmt::format("{}: condition of its wheels at {:.0f} rpm", f.rig,
                             RadPerSToRpm(f.speed_rad_per_s));
  figure.lines = {f.reasons.empty()
                      ? "multiples of a wheel's rotation, without teeth, 1x, 2x and 3x"
                      : "not comparable: " + f.reasons.front()};
  figure.columns = 2;
  for (std::size_t s = 0; s < f.sessions.front().condition.shafts.size(); ++s) {
    svg::Panel panel;
    panel.title = f.sessions.front().condition.shafts[s].wheels;
    panel.x_label = "session";
    panel.y_label = "amplitude [um]";
    svg::Series amplitude{.name = "amplitude", .mark = svg::Mark::kDot, .mark_size = 4.0};
    svg::Series noise{.name = "of noise", .colour = svg::Colour(1), .dashes = "6 3"};
    for (std::size_t i = 0; i < f.sessions.size(); ++i) {
      const auto& shafts = f.sessions[i].condition.shafts;
      if (s >= shafts.size()) continue;
      for (svg::Series* series : {&amplitude, &noise})
        series->x.push_back(static_cast<double>(i + 1));
      amplitude.y.push_back(1e6 * shafts[s].Amplitude());
      noise.y.push_back(1e6 * NoiseOf(shafts[s]));
    }
    panel.series = {std::move(amplitude), std::move(noise)};
    if (s < f.trends.size()) {
      panel.title += f.trends[s].risen ? ": rising" : ": no rise";
      const double height_um = 1e6 * f.trends[s].rises_from_m;
      panel.series.push_back({.name = "risen from here on",
                              .x = {1.0, static_cast<double>(f.sessions.size())},
                              .y = {height_um, height_um},
                              .colour = svg::Colour(2),
                              .dashes = "2 3"});
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace levitas::cli
