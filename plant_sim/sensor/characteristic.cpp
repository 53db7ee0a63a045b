#include "plant_sim/sensor/characteristic.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace levitas::sensor {
namespace {

double Chord(const ProbePoint& a, const ProbePoint& b) {
  return (b.reading_m - a.reading_m) / (b.displacement_m - a.displacement_m);
}

/// Weighted harmonic mean of the chords before and after `at`.
double SlopeAt(const std::vector<ProbePoint>& points, std::size_t at) {
  const double before_m = points[at].displacement_m - points[at - 1].displacement_m;
  const double after_m = points[at + 1].displacement_m - points[at].displacement_m;
  const double weight_before = 2.0 * after_m + before_m;
  const double weight_after = after_m + 2.0 * before_m;
  return (weight_before + weight_after) / (weight_before / Chord(points[at - 1], points[at]) +
                                           weight_after / Chord(points[at], points[at + 1]));
}

bool IsCentre(const ProbePoint& point) {
  return point.displacement_m == 0.0 && point.reading_m == 0.0;
}

}  // namespace

void CheckCharacteristic(const std::string& at, const std::vector<ProbePoint>& points) {
  if (points.empty()) return;
  if (points.size() < 2) throw std::invalid_argument(at + ": a curve needs two or more points");
  for (std::size_t i = 1; i < points.size(); ++i) {
    // Written so that NaN is refused too.
    if (!(points[i].displacement_m > points[i - 1].displacement_m &&
          points[i].reading_m > points[i - 1].reading_m)) {
      throw std::invalid_argument(at +
                                  ": displacement and reading must both ascend from point to "
                                  "point");
    }
  }
  if (std::ranges::none_of(points, IsCentre)) {
    throw std::invalid_argument(at +
                                ": one point must be the centre, displacement 0 and reading 0");
  }
}

Characteristic::Characteristic(const std::vector<ProbePoint>& points) : points_(points) {
  if (points_.empty()) return;
  slope_.resize(points_.size());
  slope_.front() = Chord(points_[0], points_[1]);
  slope_.back() = Chord(points_[points_.size() - 2], points_.back());
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) slope_[i] = SlopeAt(points_, i);
  const auto centre = std::ranges::find_if(points_, IsCentre);
  slope_at_centre_ = slope_[static_cast<std::size_t>(centre - points_.begin())];
}

double Characteristic::operator()(double displacement_m) const noexcept {
  if (points_.empty()) return displacement_m;
  const auto above =
      std::ranges::upper_bound(points_, displacement_m, {}, &ProbePoint::displacement_m);
  if (above == points_.begin()) {
    return points_.front().reading_m +
           slope_.front() * (displacement_m - points_.front().displacement_m);
  }
  if (above == points_.end()) {
    return points_.back().reading_m +
           slope_.back() * (displacement_m - points_.back().displacement_m);
  }
  const auto high = static_cast<std::size_t>(above - points_.begin());
  const ProbePoint& a = points_[high - 1];
  const ProbePoint& b = points_[high];
  const double width_m = b.displacement_m - a.displacement_m;
  const double t = (displacement_m - a.displacement_m) / width_m;
  const double r = 1.0 - t;
  return r * r * (1.0 + 2.0 * t) * a.reading_m + t * t * (3.0 - 2.0 * t) * b.reading_m +
         width_m * t * r * (r * slope_[high - 1] - t * slope_[high]);
}

}  // namespace levitas::sensor
