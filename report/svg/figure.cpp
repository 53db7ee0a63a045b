#include "report/svg/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/output_file.hpp"
#include "report/html/escaped_text.hpp"

namespace levitas::svg {
namespace {

constexpr double kLeft = 62, kRight = 16, kTop = 26, kBottom = 40;
constexpr double kTitleHeight = 28;
constexpr double kLineHeight = 15;
constexpr double kLegendHeight = 15;  // of one of its rows
constexpr double kLetter = 6.0;       // width of one, about

struct Frame {
  double left{}, right{}, top{}, bottom{};
  double title{};  ///< base line of the panel's title, the same for a row of panels
  Axis x, y;
};

double EntryWidth(const Series& s) { return 32 + kLetter * static_cast<double>(s.name.size()); }

/// Lines that the legend of a panel takes.
std::size_t LegendRows(const Panel& panel, double width) {
  std::size_t rows = 0;
  double x = width;
  for (const Series& s : panel.series) {
    if (s.name.empty()) continue;
    if (rows == 0 || x + EntryWidth(s) > width) {
      ++rows;
      x = 0.0;
    }
    x += EntryWidth(s);
  }
  return rows;
}

/// The same for every panel, so that panels of a row begin at one height.
double LegendHeight(const Figure& figure) {
  std::size_t rows = 0;
  for (const Panel& panel : figure.panels) {
    rows = std::max(rows, LegendRows(panel, figure.panel_width - kLeft - kRight));
  }
  return kLegendHeight * static_cast<double>(rows);
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

std::size_t ColumnsOf(const Figure& figure) { return std::max<std::size_t>(figure.columns, 1); }

/// Height of title and lines.
double TopOf(const Figure& figure) {
  return (figure.title.empty() ? 0.0 : kTitleHeight) +
         kLineHeight * static_cast<double>(figure.lines.size());
}

Frame FrameOf(const Figure& figure, std::size_t number) {
  const Panel& panel = figure.panels[number];
  const double x = static_cast<double>(number % ColumnsOf(figure)) * figure.panel_width;
  const double y =
      TopOf(figure) + static_cast<double>(number / ColumnsOf(figure)) * figure.panel_height;
  const double left = x + kLeft;
  const double right = x + figure.panel_width - kRight;
  const double top = y + kTop + LegendHeight(figure);
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
      f.left, f.title, html::Escaped(panel.title), 0.5 * (f.left + f.right), f.bottom + 30,
      html::Escaped(panel.x_label), f.left - 48, 0.5 * (f.top + f.bottom),
      html::Escaped(panel.y_label));
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
  return fmt::format(
      "<path d='{}' fill='{}' fill-opacity='0.6' stroke='{}' stroke-width='{}'{}/>\n", path,
      s.fill.empty() ? "none" : s.fill, s.colour, s.width, dashes);
}

std::string MarkAt(const Series& s, double x, double y) {
  const double r = s.mark_size;
  switch (s.mark) {
    case Mark::kNone:
      break;
    case Mark::kDot:
      return fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{:.1f}' fill='{}'/>", x, y, r,
                         s.colour);
    case Mark::kRing:
      return fmt::format(
          "<circle cx='{:.1f}' cy='{:.1f}' r='{:.1f}' fill='white' stroke='{}' "
          "stroke-width='1.5'/>",
          x, y, r, s.colour);
    case Mark::kCross:
      return fmt::format("<path d='M{:.1f} {:.1f}l{r} {r}m0 -{r}l-{r} {r}' stroke='{c}'/>",
                         x - r / 2, y - r / 2, fmt::arg("r", r), fmt::arg("c", s.colour));
    case Mark::kUp:
      return fmt::format("<path d='M{:.1f} {:.1f}h{:.1f}l-{r:.1f} -{:.1f}z' fill='{c}'/>", x - r,
                         y + 0.8 * r, 2 * r, 1.8 * r, fmt::arg("r", r), fmt::arg("c", s.colour));
    case Mark::kDown:
      return fmt::format(
          "<path d='M{:.1f} {:.1f}h{:.1f}l-{r:.1f} {:.1f}z' fill='white' stroke='{c}' "
          "stroke-width='1.5'/>",
          x - r, y - 0.8 * r, 2 * r, 1.8 * r, fmt::arg("r", r), fmt::arg("c", s.colour));
    case Mark::kSquare:
      return fmt::format(
          "<rect x='{:.1f}' y='{:.1f}' width='{w:.1f}' height='{w:.1f}' fill='white' "
          "stroke='{c}' stroke-width='1.5'/>",
          x - r, y - r, fmt::arg("w", 2 * r), fmt::arg("c", s.colour));
  }
  return {};
}

std::string Points(const Series& s, const Frame& f) {
  std::string svg;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const double x = f.x.Pixel(s.x[i]);
    const double y = f.y.Pixel(s.y[i]);
    if (std::isfinite(x) && std::isfinite(y)) svg += MarkAt(s, x, y);
  }
  return svg + "\n";
}

/// In rows between title and axes, so that it covers no curve.
std::string Legend(const Panel& panel, const Frame& f) {
  std::string svg;
  const std::size_t rows = LegendRows(panel, f.right - f.left);
  double x = f.left;
  double y = f.top - 9 - kLegendHeight * static_cast<double>(rows == 0 ? 0 : rows - 1);
  for (const Series& s : panel.series) {
    if (s.name.empty()) continue;
    if (x > f.left && x + EntryWidth(s) > f.right) {
      x = f.left;
      y += kLegendHeight;
    }
    if (s.width > 0.0 || s.mark == Mark::kNone || s.mark == Mark::kCross || s.mark == Mark::kDot) {
      svg += fmt::format(
          "<path d='M{:.1f} {:.1f}h16' stroke='{}' stroke-width='{}' stroke-dasharray='{}'/>", x, y,
          s.colour, std::max(s.width, 2.0), s.dashes);
    }
    if (s.mark > Mark::kCross) svg += MarkAt(s, x + 8, y);
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}' fill='{}'>{}</text>\n", x + 20, y + 4, s.colour,
                       html::Escaped(s.name));
    x += EntryWidth(s);
  }
  return svg;
}

bool Within(const Axis& axis, double value) {
  return value >= axis.range().low && value <= axis.range().high;
}

std::string Notes(const Panel& panel, const Frame& f) {
  constexpr std::array kAnchors{"start", "middle", "end"};
  std::string svg;
  for (const Note& note : panel.notes) {
    if (!Within(f.x, note.x) || !Within(f.y, note.y)) continue;
    svg += fmt::format(
        "<text x='{:.1f}' y='{:.1f}' text-anchor='{}' fill='{}' stroke='white' stroke-width='3' "
        "paint-order='stroke'>{}</text>\n",
        f.x.Pixel(note.x) + note.right_px, f.y.Pixel(note.y) + note.down_px + 4,
        kAnchors[static_cast<std::size_t>(note.anchor)], note.colour, html::Escaped(note.text));
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
    if (s.width > 0.0 || !s.fill.empty()) svg += Line(s, f);
    if (s.mark != Mark::kNone) svg += Points(s, f);
  }
  svg += "</g>\n" + Notes(panel, f) + Legend(panel, f);
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

Size SizeOf(const Figure& figure) {
  const std::size_t rows = (figure.panels.size() + ColumnsOf(figure) - 1) / ColumnsOf(figure);
  return {static_cast<double>(ColumnsOf(figure)) * figure.panel_width,
          TopOf(figure) + static_cast<double>(rows) * figure.panel_height};
}

std::vector<PanelPlace> Places(const Figure& figure) {
  std::vector<PanelPlace> places;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Frame f = FrameOf(figure, i);
    places.push_back({f.left, f.right, f.top, f.bottom, f.x.range(), f.y.range()});
  }
  return places;
}

std::string Draw(const Figure& figure) {
  const Size size = SizeOf(figure);
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:.0f} {1:.0f}' "
      "font-family='sans-serif' font-size='11'>\n<rect width='{0:.0f}' height='{1:.0f}' "
      "fill='white'/>\n",
      size.width, size.height);
  if (!figure.title.empty()) {
    svg +=
        fmt::format("<text x='12' y='19' font-size='15'>{}</text>\n", html::Escaped(figure.title));
  }
  const double lines = TopOf(figure) - kLineHeight * static_cast<double>(figure.lines.size());
  for (std::size_t i = 0; i < figure.lines.size(); ++i) {
    svg += fmt::format("<text x='12' y='{:.0f}' fill='#4b5363'>{}</text>\n",
                       lines + 9 + kLineHeight * static_cast<double>(i),
                       html::Escaped(figure.lines[i]));
  }
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    svg += DrawPanel(figure.panels[i], FrameOf(figure, i), i);
  }
  return svg + "</svg>\n";
}

void Write(const std::string& path, const Figure& figure) {
  WriteWholeFile(path, path.empty() ? std::string{} : Draw(figure));
}

}  // namespace levitas::svg
