#include "report/rig/campbell_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "common/rotational_speed.hpp"

namespace levitas::report {
namespace {

using analysis::Campbell;
using analysis::CampbellMode;
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kPerTurn = 2.0 * std::numbers::pi;
constexpr const char* kGrey = "#666666";

using Value = double (*)(const CampbellMode&);

struct Kind {
  std::string_view name;  ///< analysis::WhirlName
  const char* colour;
  const char* dashes;
  svg::Mark mark;
};
constexpr std::array<Kind, 4> kKinds{{{"forward", "#0072b2", "", svg::Mark::kUp},
                                      {"backward", "#d55e00", "7 4", svg::Mark::kDown},
                                      {"torsion", "#009e73", "2 3", svg::Mark::kSquare},
                                      {"plane", "#000000", "2 3", svg::Mark::kRing}}};

std::size_t KindOf(const CampbellMode& mode) {
  const std::string_view name = analysis::WhirlName(mode);
  const auto kind =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& k) { return k.name == name; });
  return static_cast<std::size_t>(kind - kKinds.begin());
}

/// A mode followed over the speeds: places in `speeds` and in the modes there.
struct Chain {
  std::size_t first{};
  std::vector<std::size_t> modes;
};

std::vector<Chain> ChainsOf(const Campbell& campbell) {
  std::vector<Chain> chains;
  std::vector<std::vector<bool>> seen;
  for (const auto& at : campbell.speeds) seen.emplace_back(at.modes.size());
  for (std::size_t i = 0; i < campbell.speeds.size(); ++i) {
    for (std::size_t k = 0; k < campbell.speeds[i].modes.size(); ++k) {
      if (seen[i][k]) continue;
      Chain chain{i, {}};
      std::optional<std::size_t> mode = k;
      for (std::size_t at = i; mode; ++at) {
        seen[at][*mode] = true;
        chain.modes.push_back(*mode);
        mode = at < campbell.next.size() ? campbell.next[at][*mode] : std::nullopt;
      }
      chains.push_back(std::move(chain));
    }
  }
  return chains;
}

/// What a chain is drawn as: what most of its modes are, where the rotor turns.
std::size_t KindOf(const Campbell& campbell, const Chain& chain) {
  std::array<int, kKinds.size()> votes{};
  for (std::size_t i = 0; i < chain.modes.size(); ++i) {
    const auto& at = campbell.speeds[chain.first + i];
    if (at.speed_rad_per_s > 0.0) ++votes[KindOf(at.modes[chain.modes[i]])];
  }
  return static_cast<std::size_t>(std::max_element(votes.begin(), votes.end()) - votes.begin());
}

/// Lines of all kinds that there are, then the marks, which name the kind.
void AddModes(const Campbell& campbell, Value value, svg::Panel& panel) {
  constexpr std::size_t kMarkEvery = 6;
  std::array<svg::Series, kKinds.size()> lines, marks;
  for (const Chain& chain : ChainsOf(campbell)) {
    const std::size_t kind = KindOf(campbell, chain);
    for (std::size_t i = 0; i < chain.modes.size(); ++i) {
      const auto& at = campbell.speeds[chain.first + i];
      const double rpm = RadPerSToRpm(at.speed_rad_per_s);
      lines[kind].x.push_back(rpm);
      lines[kind].y.push_back(value(at.modes[chain.modes[i]]));
      if ((chain.first + i) % kMarkEvery != kMarkEvery / 2) continue;
      marks[kind].x.push_back(rpm);
      marks[kind].y.push_back(lines[kind].y.back());
    }
    lines[kind].x.push_back(kNoNumber);
    lines[kind].y.push_back(kNoNumber);
  }
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (lines[i].x.empty()) continue;
    lines[i].colour = marks[i].colour = kKinds[i].colour;
    lines[i].dashes = kKinds[i].dashes;
    lines[i].width = 1.6;
    marks[i].name = i < 2 ? std::string(kKinds[i].name) + " whirl" : kKinds[i].name;
    marks[i].mark = kKinds[i].mark;
    marks[i].mark_size = 4.0;
    marks[i].width = 0.0;
    panel.series.push_back(lines[i]);
    panel.series.push_back(marks[i]);
  }
}

void AddRated(double rated_rad_per_s, double low, double high, svg::Panel& panel) {
  const double rpm = RadPerSToRpm(rated_rad_per_s);
  panel.series.push_back(
      {.x = {rpm, rpm}, .y = {low, high}, .colour = kGrey, .dashes = "10 3 2 3"});
  panel.notes.push_back({.x = rpm,
                         .y = high,
                         .text = fmt::format("rated {:.0f} rpm", rpm),
                         .anchor = svg::Anchor::kEnd,
                         .right_px = -5,
                         .down_px = 10,
                         .colour = kGrey});
}

/// Text of a crossing: of forward whirl below right of it, of the others above left; at an edge of
/// the panel to the other side.
svg::Note CrossingNote(const analysis::CriticalSpeed& crossing, double y, double end_rpm) {
  constexpr std::array kLetters{"F", "B", "T", "P"};
  const std::size_t kind = KindOf(crossing.mode);
  const double rpm = RadPerSToRpm(crossing.speed_rad_per_s);
  const bool right = kind == 0 ? rpm < 0.8 * end_rpm : rpm < 0.2 * end_rpm;
  return {.x = rpm,
          .y = y,
          .text = fmt::format("{:.0f} rpm {}", rpm, kLetters[kind]),
          .anchor = right ? svg::Anchor::kStart : svg::Anchor::kEnd,
          .right_px = right ? 7.0 : -7.0,
          .down_px = kind == 0 ? 11.0 : -9.0};
}

/// Whether two texts would cover each other, in shares of a panel that is some 400 pixels wide.
bool Meet(const svg::Note& a, const svg::Note& b, const svg::Panel& panel) {
  constexpr double kWide = 0.2, kHigh = 0.055;
  const auto middle = [&](const svg::Note& note) {
    const double side = note.anchor == svg::Anchor::kStart ? 0.5 : -0.5;
    return note.x / panel.x_range->high + side * kWide;
  };
  const auto height = [&](const svg::Note& note) {
    return note.y / panel.y_range->high - (note.down_px > 0.0 ? 0.5 : -0.5) * kHigh;
  };
  return std::abs(middle(a) - middle(b)) < kWide && std::abs(height(a) - height(b)) < kHigh;
}

/// Rings at all crossings; the speeds of those with room for them, forward whirl first.
void AddCrossings(const Campbell& campbell, Value value, bool with_speeds, svg::Panel& panel) {
  svg::Series rings{.name = campbell.orders.size() == 1 ? "crossing of 1x" : "crossing",
                    .colour = "#000000",
                    .width = 0.0,
                    .mark = svg::Mark::kRing,
                    .mark_size = 4.5};
  std::vector<svg::Note> notes;
  for (const auto& crossing : campbell.crossings) {
    rings.x.push_back(RadPerSToRpm(crossing.speed_rad_per_s));
    rings.y.push_back(value(crossing.mode));
    notes.push_back(CrossingNote(crossing, rings.y.back(), panel.x_range->high));
  }
  if (!rings.x.empty()) panel.series.push_back(rings);
  if (!with_speeds) return;
  std::stable_partition(notes.begin(), notes.end(),
                        [](const svg::Note& note) { return note.anchor == svg::Anchor::kStart; });
  std::vector<svg::Note> placed;
  for (const svg::Note& note : notes) {
    const bool meets = std::any_of(placed.begin(), placed.end(), [&](const svg::Note& other) {
      return Meet(note, other, panel);
    });
    if (!meets) placed.push_back(note);
  }
  panel.notes.insert(panel.notes.end(), placed.begin(), placed.end());
}

/// A line from the origin for each order, as far as the panel reaches.
void AddOrders(const Campbell& campbell, double top_hz, svg::Panel& panel) {
  constexpr std::array kDashes{"", "12 4", "2 2 8 2", "1 3"};
  const double top = campbell.speeds.back().speed_rad_per_s;
  for (std::size_t i = 0; i < campbell.orders.size(); ++i) {
    const auto& [name, per_turn] = campbell.orders[i];
    const double end = std::min(top, kPerTurn * top_hz / per_turn);
    panel.series.push_back({.name = name,
                            .x = {0.0, RadPerSToRpm(end)},
                            .y = {0.0, per_turn * end / kPerTurn},
                            .colour = "#000000",
                            .width = 1.0,
                            .dashes = kDashes[i % kDashes.size()]});
  }
}

svg::Panel PanelOf(const Campbell& campbell, const std::string& title) {
  svg::Panel panel{.title = title, .x_label = "speed, rpm"};
  panel.x_range = svg::Range{0.0, RadPerSToRpm(campbell.speeds.back().speed_rad_per_s)};
  return panel;
}

}  // namespace

svg::Panel CampbellPanel(const Campbell& campbell, const CampbellLook& look) {
  const auto frequency = [](const CampbellMode& mode) { return mode.frequency_hz; };
  svg::Panel panel = PanelOf(campbell, look.title);
  panel.y_label = "natural frequency, Hz";
  panel.y_range = svg::Range{0.0, look.top_hz};
  AddModes(campbell, frequency, panel);
  AddOrders(campbell, look.top_hz, panel);
  AddRated(look.rated_rad_per_s, 0.0, look.top_hz, panel);
  AddCrossings(campbell, frequency, true, panel);
  return panel;
}

svg::Panel DampingPanel(const Campbell& campbell, const CampbellLook& look) {
  const auto damping = [](const CampbellMode& mode) { return mode.damping_ratio; };
  svg::Panel panel = PanelOf(campbell, look.title);
  panel.y_label = "damping ratio";
  double low = 1.0;
  for (const auto& at : campbell.speeds) {
    for (const auto& mode : at.modes) low = std::min(low, mode.damping_ratio);
  }
  constexpr double kHigh = 0.75;
  if (low > 0.0) {
    panel.y_scale = svg::Scale::kLogarithmic;
    panel.y_range = svg::Range{std::min(0.5 * low, 0.1), 1.0};
  } else {
    panel.y_range = svg::Range{std::max(1.1 * low - 0.02, -kHigh), kHigh};
    const double end = panel.x_range->high;
    panel.series.push_back({.name = "grows",
                            .x = {0.0, end, end, 0.0},
                            .y = {0.0, 0.0, -kHigh, -kHigh},
                            .colour = "#d55e00",
                            .width = 0.0,
                            .fill = "#fbdcc8"});
  }
  AddModes(campbell, damping, panel);
  AddRated(look.rated_rad_per_s, panel.y_range->low, panel.y_range->high, panel);
  AddCrossings(campbell, damping, false, panel);
  return panel;
}

}  // namespace levitas::report
