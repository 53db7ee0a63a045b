#pragma once
// Static characteristic of a probe as it was measured on a positioning platform: what it reads over
// the true displacement, a table of points with a curve through them.
//
// Equation   cubic Hermite polynomial between neighbouring points; its slope at a point is the
//            weighted harmonic mean of the two chords beside it, at the ends that of the chord
//            (Fritsch & Butland 1984): monotone like the points, with a continuous slope. Beyond
//            the table the slope of its end goes on.
// Centre     the curve passes through (0, 0): a probe is calibrated at the centre of its range. Its
//            slope there is what linear models take (linear_model.hpp).
// Units      m, along the axis before its polarity. Applied before the gain and the filter.
// Thread     any; construction allocates, evaluation does not.
// Failure    CheckCharacteristic throws std::invalid_argument; the constructor expects a checked
//            table.

#include <string>
#include <vector>

#include "plant_sim/sensor/probe_point.hpp"

namespace levitas::sensor {

/// Nothing, or two or more points in ascending order of both columns, one of which is (0, 0).
void CheckCharacteristic(const std::string& at, const std::vector<ProbePoint>& points);

class Characteristic {
 public:
  Characteristic() = default;
  explicit Characteristic(const std::vector<ProbePoint>& points);

  /// Without points: reading and displacement are the same.
  [[nodiscard]] bool straight() const noexcept { return points_.empty(); }
  [[nodiscard]] double operator()(double displacement_m) const noexcept;
  [[nodiscard]] double SlopeAtCentre() const noexcept { return slope_at_centre_; }

 private:
  std::vector<ProbePoint> points_;
  std::vector<double> slope_;  ///< at each point
  double slope_at_centre_{1.0};
};

}  // namespace levitas::sensor
