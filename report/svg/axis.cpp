#include "report/svg/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace levitas::svg {
namespace {

bool Drawable(double value, Scale scale) {
  return std::isfinite(value) && (scale == Scale::kLinear || value > 0.0);
}

/// 1, 2 or 5 times a power of ten, at least `span / 8`.
double MarkStep(double span) {
  const double rough = span / 8.0;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= rough) return factor * decade;
  }
  return 10.0 * decade;
}

Range Usable(Range range, Scale scale) {
  const bool good =
      Drawable(range.low, scale) && Drawable(range.high, scale) && range.low < range.high;
  if (good) return range;
  if (!Drawable(range.low, scale)) return scale == Scale::kLinear ? Range{0, 1} : Range{1, 10};
  const double room = std::max(std::abs(range.low) * 0.5, 1e-12);
  return scale == Scale::kLinear ? Range{range.low - room, range.low + room}
                                 : Range{range.low / 2.0, range.low * 2.0};
}

}  // namespace

Range Enclose(const std::vector<std::vector<double>>& values, Scale scale) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const auto& series : values) {
    for (const double value : series) {
      if (!Drawable(value, scale)) continue;
      range.low = std::min(range.low, value);
      range.high = std::max(range.high, value);
    }
  }
  range = Usable(range, scale);
  if (scale == Scale::kLogarithmic) return {range.low / 1.1, range.high * 1.1};
  const double room = 0.04 * (range.high - range.low);
  return {range.low - room, range.high + room};
}

Axis::Axis(Range range, Scale scale, double first_pixel, double last_pixel)
    : range_(Usable(range, scale)),
      scale_(scale),
      first_pixel_(first_pixel),
      last_pixel_(last_pixel) {}

double Axis::Pixel(double value) const {
  if (!Drawable(value, scale_)) return std::numeric_limits<double>::quiet_NaN();
  const double share = scale_ == Scale::kLinear
                           ? (value - range_.low) / (range_.high - range_.low)
                           : std::log10(value / range_.low) / std::log10(range_.high / range_.low);
  return first_pixel_ + share * (last_pixel_ - first_pixel_);
}

std::vector<double> Axis::Marks() const {
  std::vector<double> marks;
  if (scale_ == Scale::kLinear) {
    const double step = MarkStep(range_.high - range_.low);
    const double first = std::ceil(range_.low / step);
    const double last = std::floor(range_.high / step + 1e-9);
    for (double n = first; n <= last; n += 1.0) marks.push_back(n * step);
    return marks;
  }
  const double low = std::floor(std::log10(range_.low));
  const double high = std::ceil(std::log10(range_.high));
  const double stride = std::max(1.0, std::ceil((high - low) / 8.0));
  const bool between = high - low < 3.5;
  for (double decade = low; decade <= high; decade += stride) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double mark = factor * std::pow(10.0, decade);
      if (factor > 1.0 && !between) break;
      if (mark >= range_.low && mark <= range_.high) marks.push_back(mark);
    }
  }
  return marks;
}

std::string MarkText(double value) {
  return fmt::format("{:.6g}", value + 0.0);  // + 0: no "-0"
}

}  // namespace levitas::svg
