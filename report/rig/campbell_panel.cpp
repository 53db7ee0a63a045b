#include "report/rig/campbell_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
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

/// A rectangle in shares of the panel's axes, from its lower left corner.
struct Box {
  double left{}, low{}, right{}, high{};
};

bool Meet(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.low < b.high && b.low < a.high;
}

/// Whether a straight line touches the box: cut down to it (Liang and Barsky 1984).
bool Touches(const Box& box, double x0, double y0, double x1, double y1) {
  double from = 0.0, to = 1.0;
  if (!std::isfinite(x0 + y0 + x1 + y1)) return false;  // a gap between two lines
  const auto cut = [&](double direction, double room) {
    if (direction == 0.0) return room >= 0.0;
    const double at = room / direction;
    (direction < 0.0 ? from : to) = direction < 0.0 ? std::max(from, at) : std::min(to, at);
    return from <= to;
  };
  return cut(x0 - x1, x0 - box.left) && cut(x1 - x0, box.right - x0) &&
         cut(y0 - y1, y0 - box.low) && cut(y1 - y0, box.high - y0);
}

/// The widest and the smallest panel that these go into have axes of so many pixels; letters are
/// 11 pixels high.
constexpr double kWidest = 822.0;
constexpr double kAxesWide = 380.0, kAxesHigh = 280.0, kLetter = 6.2, kHigh = 12.0;

Box BoxOf(const svg::Note& note, const svg::Panel& panel) {
  const double wide = kLetter * static_cast<double>(note.text.size()) / kAxesWide;
  const double at = note.x / panel.x_range->high;
  const double near = at + note.right_px / kWidest;  // from there in the widest panel
  const double x = at + note.right_px / kAxesWide;
  const double y = note.y / panel.y_range->high - note.down_px / kAxesHigh;
  const bool start = note.anchor == svg::Anchor::kStart;
  return {start ? near : x - wide, y - 0.5 * kHigh / kAxesHigh, start ? x + wide : near,
          y + 0.5 * kHigh / kAxesHigh};
}

/// Whether a text there would leave the panel, or cover a line, a mark or another text.
bool Free(const svg::Note& note, const svg::Panel& panel) {
  const Box box = BoxOf(note, panel);
  if (box.left < 0.0 || box.right > 1.0 || box.low < 0.0 || box.high > 1.0) return false;
  for (const svg::Note& other : panel.notes) {
    if (Meet(box, BoxOf(other, panel))) return false;
  }
  for (const svg::Series& series : panel.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const double x = series.x[i] / panel.x_range->high, y = series.y[i] / panel.y_range->high;
      if (series.mark != svg::Mark::kNone) {
        const double wide = series.mark_size / kAxesWide, high = series.mark_size / kAxesHigh;
        if (Meet(box, {x - wide, y - high, x + wide, y + high})) return false;
      }
      if (series.width <= 0.0 || i == 0) continue;
      if (Touches(box, series.x[i - 1] / panel.x_range->high, series.y[i - 1] / panel.y_range->high,
                  x, y)) {
        return false;
      }
    }
  }
  return true;
}

/// Text of a crossing at the nearest place that is free: of forward whirl rather below right of it,
/// of the others above left. None: the command's table has it.
std::optional<svg::Note> CrossingNote(const analysis::CriticalSpeed& crossing, double y,
                                      const svg::Panel& panel) {
  constexpr std::array kLetters{"F", "B", "T", "P"};
  const std::size_t kind = KindOf(crossing.mode);
  const double rpm = RadPerSToRpm(crossing.speed_rad_per_s);
  svg::Note note{.x = rpm, .y = y, .text = fmt::format("{:.0f} rpm {}", rpm, kLetters[kind])};
  const double first = kind == 0 ? 1.0 : -1.0;
  for (const double away : {11.0, 15.0, 20.0, 26.0, 34.0}) {
    for (const double right : {7.0, 14.0, 24.0}) {
      for (const double side : {first, -first}) {
        for (const double down : {first, -first}) {
          note.anchor = side > 0.0 ? svg::Anchor::kStart : svg::Anchor::kEnd;
          note.right_px = side * right;
          note.down_px = down * away;
          if (Free(note, panel)) return note;
        }
      }
    }
  }
  return std::nullopt;
}

/// Rings at all crossings; the speeds of those with room for them, forward whirl first.
void AddCrossings(const Campbell& campbell, Value value, bool with_speeds, svg::Panel& panel) {
  svg::Series rings{.name = campbell.orders.size() == 1 ? "crossing of 1x" : "crossing",
                    .colour = "#000000",
                    .width = 0.0,
                    .mark = svg::Mark::kRing,
                    .mark_size = 4.5};
  for (const auto& crossing : campbell.crossings) {
    rings.x.push_back(RadPerSToRpm(crossing.speed_rad_per_s));
    rings.y.push_back(value(crossing.mode));
  }
  if (rings.x.empty()) return;
  const std::vector<double> heights = rings.y;
  panel.series.push_back(std::move(rings));
  if (!with_speeds) return;
  for (const bool forward : {true, false}) {
    for (std::size_t i = 0; i < campbell.crossings.size(); ++i) {
      if ((KindOf(campbell.crossings[i].mode) == 0) != forward) continue;
      auto note = CrossingNote(campbell.crossings[i], heights[i], panel);
      if (note) panel.notes.push_back(*std::move(note));
    }
  }
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
  panel.notes.insert(panel.notes.end(), look.notes.begin(), look.notes.end());
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
