#include "report/rig/margins_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "analysis/speed_sweep.hpp"
#include "common/rotational_speed.hpp"

namespace levitas::report {
namespace {

struct ZoneBand {
  const char* name;
  double low;  ///< of |S|
  const char* colour;
};
/// From the worst to the best, so that each is drawn over what is larger about -1.
constexpr std::array<ZoneBand, 4> kZones{{{"zone A", 0.0, "#ffffff"},
                                          {"zone B", 3.0, "#fdf3cf"},
                                          {"zone C", 4.0, "#fbdcb4"},
                                          {"zone D", 5.0, "#f3b9a6"}}};

constexpr double kLetterShare = 0.0165;  // of a panel's width
constexpr double kLineShare = 0.055;     // of a panel's height: a line of text and a gap

std::string SpeedText(const analysis::SensitivityResult& at) {
  const double rpm = RadPerSToRpm(at.speed_rad_per_s);
  if (!at.point.failure.empty()) return fmt::format("{:.0f} rpm, not held: no grade", rpm);
  if (!at.zone) return fmt::format("{:.0f} rpm, UNSTABLE: no grade", rpm);
  return fmt::format("{:.0f} rpm, zone {}", rpm, analysis::Name(*at.zone));
}

svg::Series AxisLine(std::size_t axis, const std::vector<std::string>& channels) {
  constexpr std::array kDashes{"", "7 3", "2 2", "9 3 2 3"};
  return {.name = channels[axis],
          .colour = svg::Colour(axis),
          .width = 1.5,
          .dashes = kDashes[axis % kDashes.size()]};
}

svg::Series PeakDot(std::size_t axis, double x, double y) {
  return {.x = {x},
          .y = {y},
          .colour = svg::Colour(axis),
          .width = 0.0,
          .mark = svg::Mark::kDot,
          .mark_size = 3.5};
}

void AddBands(double first_hz, double last_hz, double high, svg::Panel& panel) {
  for (std::size_t i = 1; i < kZones.size(); ++i) {
    const double low = kZones[i].low;
    const double end = i + 1 < kZones.size() ? kZones[i + 1].low : std::max(high, 10.0);
    panel.series.push_back({.x = {first_hz, last_hz, last_hz, first_hz},
                            .y = {low, low, end, end},
                            .colour = "#b0561f",
                            .width = 0.0,
                            .fill = kZones[i].colour});
    panel.series.push_back(
        {.x = {first_hz, last_hz}, .y = {low, low}, .colour = "#b0561f", .width = 0.7});
    panel.notes.push_back({.x = first_hz,
                           .y = std::sqrt(low * end),
                           .text = fmt::format("{} from {:g}", kZones[i].name, low),
                           .right_px = 4,
                           .colour = "#7a3b12"});
  }
}

svg::Series Ring(double radius, const char* fill) {
  constexpr int kPoints = 72;
  svg::Series circle{.colour = "#b0561f", .width = 0.7, .fill = fill};
  for (int i = 0; i <= kPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPoints;
    circle.x.push_back(-1.0 + radius * std::cos(angle));
    circle.y.push_back(radius * std::sin(angle));
  }
  return circle;
}

std::complex<double> LoopOf(std::complex<double> sensitivity) { return 1.0 / sensitivity - 1.0; }

std::size_t NearestPoint(const std::vector<double>& frequency_hz, double wanted_hz) {
  const auto nearest = std::min_element(
      frequency_hz.begin(), frequency_hz.end(),
      [&](double a, double b) { return std::abs(a - wanted_hz) < std::abs(b - wanted_hz); });
  return static_cast<std::size_t>(nearest - frequency_hz.begin());
}

void AddRotation(const analysis::SensitivityResult& at, double low, double high,
                 svg::Panel& panel) {
  const double hz = std::abs(at.speed_rad_per_s) / (2.0 * std::numbers::pi);
  if (!(hz > panel.x_range->low && hz < panel.x_range->high)) return;
  panel.series.push_back({.x = {hz, hz}, .y = {low, high}, .colour = "#666666", .dashes = "3 3"});
  panel.notes.push_back({.x = hz, .y = low, .text = "1x", .right_px = 3, .down_px = -8});
}

/// A place of the loop of one axis with its frequency, as it is written beside it.
struct Place {
  std::complex<double> loop;
  std::string text;
};

/// Where the loop crosses the negative real axis at 1/factor, to the frequency grid's width.
std::optional<Place> Crossing(const analysis::SensitivityCurves& curves, std::size_t axis,
                              double factor) {
  constexpr double kSame = 0.05;  // of the factor: crossings of one loop lie further apart
  const auto is_it = [&](std::complex<double> loop) {
    return loop.real() < 0.0 && std::abs(-1.0 / loop.real() - factor) < kSame * factor;
  };
  const auto& values = curves.axes[axis];
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const auto a = LoopOf(values[i]), b = LoopOf(values[i + 1]);
    if ((a.imag() < 0.0) == (b.imag() < 0.0)) continue;
    const double share = a.imag() / (a.imag() - b.imag());
    const auto there = a + share * (b - a);
    if (!is_it(there)) continue;
    const double hz =
        curves.frequency_hz[i] + share * (curves.frequency_hz[i + 1] - curves.frequency_hz[i]);
    return Place{there, fmt::format("gain x {:.3g}: {:.1f} Hz", factor, hz)};
  }
  if (!is_it(LoopOf(values.front()))) return std::nullopt;
  return Place{LoopOf(values.front()), fmt::format("gain x {:.3g}: 0 Hz", factor)};
}

/// The peak of |S| and the places of the margins, of the axis that the picture of |S| names.
std::vector<Place> PlacesOf(const LoopAtSpeed& loop, std::size_t axis) {
  const auto& at = loop.peaks.axes[axis];
  const auto near = [&](double hz) {
    return LoopOf(loop.curves.axes[axis][NearestPoint(loop.curves.frequency_hz, hz)]);
  };
  std::vector<Place> places{
      {near(at.frequency_hz), fmt::format("|S| {:.2f}: {:.1f} Hz", at.peak, at.frequency_hz)}};
  const auto& margins = at.margins;
  if (margins.phase_rad && margins.phase_at_hz) {
    places.push_back(
        {near(*margins.phase_at_hz),
         fmt::format("phase {:.0f} degrees: {:.1f} Hz",
                     *margins.phase_rad * 180.0 / std::numbers::pi, *margins.phase_at_hz)});
  }
  for (const auto& gain : {margins.gain_up, margins.gain_down}) {
    if (!gain) continue;
    if (auto place = Crossing(loop.curves, axis, *gain)) places.push_back(*std::move(place));
  }
  return places;
}

/// The order in which lines from a column of texts to the places are shortest together: then none
/// crosses another. There are four places at most.
void SortForShortLines(std::complex<double> first, double line, std::vector<Place>& places) {
  const auto length = [&](const std::vector<Place>& order) {
    double sum = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const double down = line * static_cast<double>(i + 1);
      sum += std::abs(order[i].loop - first + std::complex<double>(0.0, down));
    }
    return sum;
  };
  const auto by_text = [](const Place& a, const Place& b) { return a.text < b.text; };
  std::ranges::sort(places, by_text);
  std::vector<Place> best = places;
  while (std::next_permutation(places.begin(), places.end(), by_text)) {
    if (length(places) < length(best)) best = places;
  }
  places = std::move(best);
}

/// In a column at the left edge, each a line of text from the next.
void AddPlaces(const LoopAtSpeed& loop, const std::vector<std::string>& channels,
               svg::Panel& panel) {
  const std::size_t axis = analysis::WorstAxis(loop.peaks);
  std::vector<Place> places = PlacesOf(loop, axis);
  const svg::Range& x = *panel.x_range;
  const svg::Range& y = *panel.y_range;
  const double line = kLineShare * (y.high - y.low);
  const double left = x.low + 0.02 * (x.high - x.low);
  std::size_t letters = 0;
  for (const Place& place : places) letters = std::max(letters, place.text.size());
  // Lines begin right of the longest text, so that they cross none.
  const double right = left + kLetterShare * static_cast<double>(letters + 1) * (x.high - x.low);
  double height = y.low + line * (static_cast<double>(places.size()) + 0.5);
  panel.notes.push_back({.x = left, .y = height, .text = channels[axis] + ":"});
  SortForShortLines({right, height}, line, places);
  for (const Place& place : places) {
    height -= line;
    panel.series.push_back({.x = {right, place.loop.real()},
                            .y = {height, place.loop.imag()},
                            .colour = "#555555",
                            .width = 0.6});
    panel.series.push_back({.x = {place.loop.real()},
                            .y = {place.loop.imag()},
                            .colour = "#000000",
                            .width = 0.0,
                            .mark = svg::Mark::kRing,
                            .mark_size = 3.0});
    panel.notes.push_back({.x = left, .y = height, .text = place.text});
  }
}

}  // namespace

svg::Panel SensitivityPanel(const LoopAtSpeed& loop, const std::vector<std::string>& channels) {
  const auto& at = loop.peaks;
  svg::Panel panel{.title = "Sensitivity |S| at " + SpeedText(at),
                   .x_label = "frequency, Hz",
                   .y_label = "|S|",
                   .x_scale = svg::Scale::kLogarithmic,
                   .y_scale = svg::Scale::kLogarithmic};
  double high = 10.0;
  double first_hz = 1.0;
  for (const auto& axis : at.axes) {
    high = std::max(high, 1.4 * axis.peak);
    if (axis.frequency_hz < first_hz) first_hz = loop.curves.frequency_hz.front();
  }
  constexpr double kLow = 0.05;
  const double last_hz = loop.curves.frequency_hz.back();
  panel.x_range = svg::Range{first_hz, last_hz};
  panel.y_range = svg::Range{kLow, high};
  AddBands(first_hz, last_hz, high, panel);
  for (std::size_t i = 0; i < at.axes.size(); ++i) {
    svg::Series line = AxisLine(i, channels);
    line.x = loop.curves.frequency_hz;
    for (const auto value : loop.curves.axes[i]) line.y.push_back(std::abs(value));
    panel.series.push_back(std::move(line));
  }
  for (std::size_t i = 0; i < at.axes.size(); ++i) {
    panel.series.push_back(PeakDot(i, at.axes[i].frequency_hz, at.axes[i].peak));
  }
  AddRotation(at, kLow, high, panel);
  const std::size_t worst = analysis::WorstAxis(at);
  const auto& axis = at.axes[worst];
  const bool right = std::log(axis.frequency_hz / first_hz) > 0.5 * std::log(last_hz / first_hz);
  panel.notes.push_back(
      {.x = axis.frequency_hz,
       .y = axis.peak,
       .text = fmt::format("{} {:.2f} at {:.1f} Hz", channels[worst], axis.peak, axis.frequency_hz),
       .anchor = right ? svg::Anchor::kEnd : svg::Anchor::kStart,
       .right_px = right ? -6.0 : 6.0,
       .down_px = -8.0});
  return panel;
}

svg::Panel NyquistPanel(const LoopAtSpeed& loop, const std::vector<std::string>& channels) {
  svg::Panel panel{.title = "Nyquist: loop of each axis, the others closed",
                   .x_label = "Re L",
                   .y_label = "Im L"};
  panel.x_range = svg::Range{-3.5, 1.5};
  panel.y_range = svg::Range{-2.0, 2.0};
  panel.same_scale = true;
  for (std::size_t i = 1; i < kZones.size(); ++i) {
    panel.series.push_back(Ring(1.0 / kZones[i].low, kZones[i].colour));
  }
  for (std::size_t i = 0; i < loop.curves.axes.size(); ++i) {
    svg::Series line = AxisLine(i, channels);
    for (const auto value : loop.curves.axes[i]) {
      line.x.push_back(LoopOf(value).real());
      line.y.push_back(LoopOf(value).imag());
    }
    panel.series.push_back(std::move(line));
  }
  for (std::size_t i = 0; i < loop.curves.axes.size(); ++i) {
    const std::size_t at = NearestPoint(loop.curves.frequency_hz, loop.peaks.axes[i].frequency_hz);
    const auto value = LoopOf(loop.curves.axes[i][at]);
    panel.series.push_back(PeakDot(i, value.real(), value.imag()));
  }
  AddPlaces(loop, channels, panel);
  panel.series.push_back({.x = {-1.0},
                          .y = {0.0},
                          .colour = "#000000",
                          .width = 0.0,
                          .mark = svg::Mark::kCross,
                          .mark_size = 7});
  panel.notes.push_back(
      {.x = -1.0, .y = 0.0, .text = "-1", .anchor = svg::Anchor::kEnd, .right_px = -6});
  return panel;
}

svg::Figure MarginsPicture(const std::string& title, const std::vector<LoopAtSpeed>& loops,
                           const std::vector<std::string>& channels) {
  svg::Figure figure{.title = title, .columns = 2, .panel_width = 460, .panel_height = 360};
  figure.lines.push_back(
      "Sampled loop, delay included; zones of ISO 14839-3, about -1 circles of radius 1/3, 1/4 "
      "and 1/5; dots: largest |S| of an axis; rings: margins of the worst axis");
  for (const LoopAtSpeed& loop : loops) {
    figure.panels.push_back(SensitivityPanel(loop, channels));
    figure.panels.push_back(NyquistPanel(loop, channels));
  }
  return figure;
}

}  // namespace levitas::report
