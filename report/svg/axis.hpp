#pragma once
// One axis of a picture: from values to pixels, and where its marks stand.
//
// Scale    linear or logarithmic; a logarithmic axis maps log10(value), values <= 0 have no place.
// Marks    linear: 1, 2 or 5 times a power of ten, at most about eight; logarithmic: the decades,
//          with 2 and 5 between them when there are fewer than three.
// Thread   any. Failure: none; an empty or reversed range is widened to something drawable.

#include <string>
#include <vector>

namespace levitas::svg {

enum class Scale { kLinear, kLogarithmic };

struct Range {
  double low{};
  double high{};
};

/// Smallest range that holds every drawable value, with a little room; {0, 1} or {1, 10} if none.
[[nodiscard]] Range Enclose(const std::vector<std::vector<double>>& values, Scale scale);

class Axis {
 public:
  Axis(Range range, Scale scale, double first_pixel, double last_pixel);

  /// Pixel of a value; NaN where the scale has no place for it.
  [[nodiscard]] double Pixel(double value) const;
  [[nodiscard]] std::vector<double> Marks() const;
  [[nodiscard]] const Range& range() const noexcept { return range_; }

 private:
  Range range_;
  Scale scale_;
  double first_pixel_;
  double last_pixel_;
};

/// "0.5", "20", "1e-7": short text of a mark.
[[nodiscard]] std::string MarkText(double value);

}  // namespace levitas::svg
