#pragma once
// Pictures as SVG text: panels in a grid, each with axes, marks, lines, points and a legend.
//
// Units    pixels inside; whatever the data has, said by the labels.
// Gaps     a value that an axis has no place for (NaN, <= 0 on a logarithmic axis) interrupts a
//          line; points beyond given limits are cut at the panel's edge.
// Thread   any; allocates.
// Failure  std::invalid_argument when a series has x and y of different length.
// Not done no interaction, no text measurement: labels are taken to be short.

#include <optional>
#include <string>
#include <vector>

#include "report/svg/axis.hpp"

namespace levitas::svg {

enum class Mark { kNone, kDot, kCross };

struct Series {
  std::string name{};  ///< in the legend; empty = not listed
  std::vector<double> x{};
  std::vector<double> y{};
  std::string colour{"#1f77b4"};
  double width{1.2};     ///< of the line; 0 = no line
  std::string dashes{};  ///< "6 3"; empty = solid
  Mark mark{Mark::kNone};
  double mark_size{2.5};
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
};

struct Figure {
  std::string title{};
  std::size_t columns{1};
  double panel_width{420};
  double panel_height{260};
  std::vector<Panel> panels{};  ///< row by row
};

/// Colour n of a palette that people with colour blindness can tell apart; repeats after eight.
[[nodiscard]] std::string Colour(std::size_t n);

[[nodiscard]] std::string Draw(const Figure& figure);

/// Draws into a file; BadInput when it cannot be written. Does nothing when `path` is empty.
void Write(const std::string& path, const Figure& figure);

}  // namespace levitas::svg
