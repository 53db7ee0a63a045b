#include "design/pid/survey_samples.hpp"

#include <cmath>

namespace levitas::design {
namespace {

/// Top of the parabola of 1/value^2 through three points.
PeakAt Vertex(std::pair<double, double> a, std::pair<double, double> b,
              std::pair<double, double> c) {
  const double x1 = a.first - b.first;
  const double x2 = c.first - b.first;
  const double y0 = 1.0 / (b.second * b.second);
  const double y1 = 1.0 / (a.second * a.second) - y0;
  const double y2 = 1.0 / (c.second * c.second) - y0;
  const double curve = (y1 / x1 - y2 / x2) / (x1 - x2);
  const double slope = y1 / x1 - curve * x1;
  if (!(curve > 0.0)) return {b.second, b.first};
  const double lowest = y0 - slope * slope / (4.0 * curve);
  const double x = -slope / (2.0 * curve);
  // Beyond a factor of two the points are no resonance's.
  if (!(lowest > 0.25 * y0) || x < x1 || x > x2) return {b.second, b.first};
  return {1.0 / std::sqrt(lowest), b.first + x};
}

}  // namespace

double Turn(const Sample& from, const Sample& to) {
  return std::arg(to.determinant * std::conj(from.determinant));
}

double Turned(const std::vector<Sample>& samples) {
  double sum = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) sum += Turn(samples[i - 1], samples[i]);
  return sum;
}

PeakAt LargestOf(const std::vector<Sample>& samples, double Sample::*of) {
  PeakAt out;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double here = samples[i].*of;
    if (here > out.value) out = {here, samples[i].hz};
    if (i == 0 || i + 1 == samples.size()) continue;
    const double left = samples[i - 1].*of;
    const double right = samples[i + 1].*of;
    if (here < left || here < right || !(left > 0.0) || !(right > 0.0)) continue;
    const PeakAt top =
        Vertex({samples[i - 1].hz, left}, {samples[i].hz, here}, {samples[i + 1].hz, right});
    if (top.value > out.value) out = top;
  }
  return out;
}

void AddNoise(const std::vector<Sample>& samples, std::size_t axes, LoopSurvey& out) {
  const double last_hz = samples.back().hz;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    double current = 0.0;
    double position = 0.0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const Sample& a = samples[i - 1];
      const Sample& b = samples[i];
      const double width = 0.5 * (b.hz - a.hz) / last_hz;
      current += width * (a.current[axis] + b.current[axis]);
      position += width * (a.position[axis] + b.position[axis]);
    }
    out.current_a.push_back(std::sqrt(current));
    out.position_m.push_back(std::sqrt(position));
  }
}

}  // namespace levitas::design
