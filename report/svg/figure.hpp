#pragma once
// Pictures as SVG text: panels in a grid, each with axes, marks, lines, points and a legend.
//
// Units    pixels inside; whatever the data has, said by the labels.
// Gaps     a value that an axis has no place for (NaN, <= 0 on a logarithmic axis) interrupts a
//          line; points beyond given limits are cut at the panel's edge.
// Thread   any; allocates.
// Failure  std::invalid_argument when a series has x and y of different length.
// Notes    texts at a place of the data, on a white rim so that lines do not cross them out.
// Not done no interaction, no text measurement: labels are taken to be short, and notes may meet.

#include <optional>
#include <string>
#include <vector>

#include "report/svg/axis.hpp"

namespace levitas::svg {

/// kUp and kDown are triangles, a full and a hollow one: told apart without colour.
enum class Mark { kNone, kDot, kCross, kRing, kUp, kDown, kSquare };

struct Series {
  std::string name{};  ///< in the legend; empty = not listed
  std::vector<double> x{};
  std::vector<double> y{};
  std::string colour{"#1f77b4"};
  double width{1.2};     ///< of the line; 0 = no line
  std::string dashes{};  ///< "6 3"; empty = solid
  Mark mark{Mark::kNone};
  double mark_size{2.5};
  std::string fill{};  ///< colour of the area that the line encloses; empty = none
};

enum class Anchor { kStart, kMiddle, kEnd };

/// A text at a place of the data, moved by some pixels.
struct Note {
  double x{};
  double y{};
  std::string text{};
  Anchor anchor{Anchor::kStart};
  double right_px{};
  double down_px{};
  std::string colour{"#1f2430"};
};

struct Panel {
  std::string title{};
  std::string x_label{};
  std::string y_label{};
  Scale x_scale{Scale::kLinear};
  Scale y_scale{Scale::kLinear};
  std::optional<Range> x_range{};  ///< else all data
  std::optional<Range> y_range{};
  bool same_scale{};  ///< linear axes: one unit is as long along y as along x, so circles are round
  std::vector<Series> series{};
  std::vector<Note> notes{};  ///< those beyond the given limits are left out
};

struct Figure {
  std::string title{};
  std::vector<std::string> lines{};  ///< of small text below the title
  std::size_t columns{1};
  double panel_width{420};
  double panel_height{260};
  std::vector<Panel> panels{};  ///< row by row
};

/// Colour n of a palette that people with colour blindness can tell apart; repeats after eight.
[[nodiscard]] std::string Colour(std::size_t n);

/// Where a panel's axes stand in the drawing, and what they show: for a cursor.
struct PanelPlace {
  double left{}, right{}, top{}, bottom{};
  Range x{}, y{};
};
/// One per panel, in their order.
[[nodiscard]] std::vector<PanelPlace> Places(const Figure& figure);
struct Size {
  double width{}, height{};
};
[[nodiscard]] Size SizeOf(const Figure& figure);

[[nodiscard]] std::string Draw(const Figure& figure);

/// Draws into a file; BadInput when it cannot be written. Does nothing when `path` is empty.
void Write(const std::string& path, const Figure& figure);

}  // namespace levitas::svg
