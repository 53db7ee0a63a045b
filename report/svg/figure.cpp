#include "report/svg/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/output_file.hpp"
#include "report/svg/escaped_text.hpp"

namespace levitas::svg {
namespace {

constexpr double kLeft = 62, kRight = 12, kTop = 26, kBottom = 40;
constexpr double kTitleHeight = 28;
constexpr double kLegendHeight = 15;
constexpr double kLetter = 6.0;  // width of one, about

struct Frame {
  double left{}, right{}, top{}, bottom{};
  double title{};  ///< base line of the panel's title, the same for a row of panels
  Axis x, y;
};

bool HasLegend(const Figure& figure) {
  return std::any_of(figure.panels.begin(), figure.panels.end(), [](const Panel& panel) {
    return std::any_of(panel.series.begin(), panel.series.end(),
                       [](const Series& s) { return !s.name.empty(); });
  });
}

/// `range` about its middle, `times` as long.
Range Stretched(Range range, double times) {
  const double middle = 0.5 * (range.low + range.high);
  const double half = 0.5 * times * (range.high - range.low);
  return {middle - half, middle + half};
}

Range RangeOf(const Panel& panel, bool x) {
  const auto& given = x ? panel.x_range : panel.y_range;
  if (given) return *given;
  std::vector<std::vector<double>> values;
  values.reserve(panel.series.size());
  for (const Series& s : panel.series) values.push_back(x ? s.x : s.y);
  return Enclose(values, x ? panel.x_scale : panel.y_scale);
}

Frame FrameOf(const Panel& panel, double x, double y, const Figure& figure) {
  const double left = x + kLeft;
  const double right = x + figure.panel_width - kRight;
  const double top = y + kTop + (HasLegend(figure) ? kLegendHeight : 0.0);
  const double bottom = y + figure.panel_height - kBottom;
  Range x_range = RangeOf(panel, true);
  Range y_range = RangeOf(panel, false);
  if (panel.same_scale) {
    const double x_unit = (x_range.high - x_range.low) / (right - left);
    const double y_unit = (y_range.high - y_range.low) / (bottom - top);
    (x_unit < y_unit ? x_range : y_range) =
        x_unit < y_unit ? Stretched(x_range, y_unit / x_unit) : Stretched(y_range, x_unit / y_unit);
  }
  return {left,
          right,
          top,
          bottom,
          y + kTop - 8,
          Axis(x_range, panel.x_scale, left, right),
          Axis(y_range, panel.y_scale, bottom, top)};
}

std::string Grid(const Panel& panel, const Frame& f) {
  std::string svg;
  for (const double mark : f.x.Marks()) {
    svg += fmt::format(
        "<path d='M{0:.1f} {1:.1f}V{2:.1f}' stroke='#ddd'/>"
        "<text x='{0:.1f}' y='{3:.1f}' text-anchor='middle'>{4}</text>\n",
        f.x.Pixel(mark), f.top, f.bottom, f.bottom + 14, MarkText(mark));
  }
  for (const double mark : f.y.Marks()) {
    svg += fmt::format(
        "<path d='M{0:.1f} {1:.1f}H{2:.1f}' stroke='#ddd'/>"
        "<text x='{3:.1f}' y='{4:.1f}' text-anchor='end'>{5}</text>\n",
        f.left, f.y.Pixel(mark), f.right, f.left - 4, f.y.Pixel(mark) + 4, MarkText(mark));
  }
  svg += fmt::format(
      "<text x='{:.1f}' y='{:.1f}' font-weight='bold'>{}</text>\n"
      "<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n"
      "<text transform='translate({:.1f} {:.1f}) rotate(-90)' text-anchor='middle'>{}</text>\n",
      f.left, f.title, Escaped(panel.title), 0.5 * (f.left + f.right), f.bottom + 30,
      Escaped(panel.x_label), f.left - 48, 0.5 * (f.top + f.bottom), Escaped(panel.y_label));
  return svg;
}

/// The line in pieces, one per uninterrupted run of drawable points.
std::string Line(const Series& s, const Frame& f) {
  std::string path;
  bool drawing = false;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const double x = f.x.Pixel(s.x[i]);
    const double y = f.y.Pixel(s.y[i]);
    const bool good = std::isfinite(x) && std::isfinite(y);
    // Far outside the panel a coordinate only costs bytes; the clip path hides the rest.
    if (good) {
      path += fmt::format("{}{:.1f} {:.1f}", drawing ? 'L' : 'M', x, std::clamp(y, -1e5, 1e5));
    }
    drawing = good;
  }
  if (path.empty()) return {};
  const std::string dashes =
      s.dashes.empty() ? "" : fmt::format(" stroke-dasharray='{}'", s.dashes);
  return fmt::format("<path d='{}' fill='none' stroke='{}' stroke-width='{}'{}/>\n", path, s.colour,
                     s.width, dashes);
}

std::string Points(const Series& s, const Frame& f) {
  std::string svg;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const double x = f.x.Pixel(s.x[i]);
    const double y = f.y.Pixel(s.y[i]);
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    const double r = s.mark_size;
    svg += s.mark == Mark::kDot
               ? fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{:.1f}' fill='{}'/>", x, y, r,
                             s.colour)
               : fmt::format("<path d='M{:.1f} {:.1f}l{r} {r}m0 -{r}l-{r} {r}' stroke='{c}'/>",
                             x - r / 2, y - r / 2, fmt::arg("r", r), fmt::arg("c", s.colour));
  }
  return svg + "\n";
}

/// One line between title and axes, so that it covers no curve.
std::string Legend(const Panel& panel, const Frame& f) {
  std::string svg;
  double x = f.left;
  for (const Series& s : panel.series) {
    if (s.name.empty()) continue;
    svg += fmt::format(
        "<path d='M{:.1f} {:.1f}h16' stroke='{c}' stroke-width='2' stroke-dasharray='{}'/>"
        "<text x='{:.1f}' y='{:.1f}' fill='{c}'>{}</text>\n",
        x, f.top - 9, s.dashes, x + 20, f.top - 5, Escaped(s.name), fmt::arg("c", s.colour));
    x += 32 + kLetter * static_cast<double>(s.name.size());
  }
  return svg;
}

std::string DrawPanel(const Panel& panel, const Frame& f, std::size_t number) {
  std::string svg = Grid(panel, f);
  svg += fmt::format(
      "<clipPath id='panel{0}'><rect x='{1:.1f}' y='{2:.1f}' width='{3:.1f}' height='{4:.1f}'/>"
      "</clipPath>\n<g clip-path='url(#panel{0})'>\n",
      number, f.left, f.top, f.right - f.left, f.bottom - f.top);
  for (const Series& s : panel.series) {
    if (s.x.size() != s.y.size()) {
      throw std::invalid_argument("svg: series '" + s.name + "' has x and y of different length");
    }
    if (s.width > 0.0) svg += Line(s, f);
    if (s.mark != Mark::kNone) svg += Points(s, f);
  }
  svg += "</g>\n" + Legend(panel, f);
  return svg + fmt::format(
                   "<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='none' "
                   "stroke='#444'/>\n",
                   f.left, f.top, f.right - f.left, f.bottom - f.top);
}

}  // namespace

std::string Colour(std::size_t n) {
  // Okabe & Ito (2008), without the yellow that vanishes on white.
  constexpr std::array kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                "#e69f00", "#56b4e9", "#000000", "#888888"};
  return kColours[n % kColours.size()];
}

std::string Draw(const Figure& figure) {
  const std::size_t columns = std::max<std::size_t>(figure.columns, 1);
  const std::size_t rows = (figure.panels.size() + columns - 1) / columns;
  const double top = figure.title.empty() ? 0.0 : kTitleHeight;
  const double width = static_cast<double>(columns) * figure.panel_width;
  const double height = top + static_cast<double>(rows) * figure.panel_height;
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:.0f} {1:.0f}' "
      "font-family='sans-serif' font-size='11'>\n<rect width='{0:.0f}' height='{1:.0f}' "
      "fill='white'/>\n",
      width, height);
  if (!figure.title.empty()) {
    svg += fmt::format("<text x='12' y='19' font-size='15'>{}</text>\n", Escaped(figure.title));
  }
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const std::size_t row = i / columns;
    const double x = static_cast<double>(i % columns) * figure.panel_width;
    const double y = top + static_cast<double>(row) * figure.panel_height;
    svg += DrawPanel(figure.panels[i], FrameOf(figure.panels[i], x, y, figure), i);
  }
  return svg + "</svg>\n";
}

void Write(const std::string& path, const Figure& figure) {
  WriteWholeFile(path, path.empty() ? std::string{} : Draw(figure));
}

}  // namespace levitas::svg
