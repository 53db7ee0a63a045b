// What happened over time: distance from the centre, ISO zones, speed, currents, sampling.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/histogram.hpp"
#include "common/rotational_speed.hpp"
#include "report/session/pictures.hpp"

namespace levitas::report {
namespace {

constexpr std::size_t kBuckets = 500;  // about one per pixel of a picture
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// Calls `each(first, end)` with the indices of every bucket.
template <class Each>
void ForBuckets(const Recording& r, Each each) {
  const std::size_t size = std::max<std::size_t>(1, (r.size() + kBuckets - 1) / kBuckets);
  for (std::size_t first = 0; first < r.size(); first += size) {
    each(first, std::min(first + size, r.size()));
  }
}

/// Largest radius of each bucket [m]; `judged`: of the levitated rotor only, else nothing.
svg::Series LargestRadius(const Recording& r, std::size_t bearing, bool judged, double scale) {
  svg::Series series;
  series.name = r.rig.bearings[bearing];
  series.colour = svg::Colour(bearing);
  ForBuckets(r, [&](std::size_t first, std::size_t end) {
    double largest = kNothing;
    for (std::size_t i = first; i < end; ++i) {
      if (judged && !r.levitated[i]) continue;
      largest = std::fmax(largest, r.Radius(bearing, i));  // ignores what is not a number
    }
    series.x.push_back(r.TimeOf(first));
    series.y.push_back(largest * scale);
  });
  return series;
}

NamedPicture DistancePicture(const Recording& r) {
  svg::Panel panel{"distance from the centre of the clearance", "time, s", "distance, µm"};
  for (std::size_t b = 0; b < r.rig.bearings.size(); ++b) {
    panel.series.push_back(LargestRadius(r, b, false, kUm));
  }
  const double widest_m = r.rig.LargestClearance();
  panel.series.push_back(Level("clearance", 0.0, r.TimeOf(r.size() - 1), r.rig.clearance_m * kUm));
  if (widest_m > r.rig.clearance_m) {
    panel.series.push_back(Level("widest", 0.0, r.TimeOf(r.size() - 1), widest_m * kUm));
  }
  panel.x_range = svg::Range{0.0, r.TimeOf(r.size() - 1)};
  panel.y_range = {0.0, 1.15 * widest_m * kUm};
  return {"distance",
          "Largest distance of the shaft from the centre at the sensors, per stretch of time; "
          "dashed: the clearance of the touchdown bearings.",
          Wide(std::move(panel))};
}

NamedPicture ZonesPicture(const Recording& r) {
  svg::Panel panel{"ISO 14839-2: zone A < 0.3, B < 0.4, C < 0.5", "time, s",
                   "share of the clearance"};
  double largest = 0.0;
  for (std::size_t b = 0; b < r.rig.bearings.size(); ++b) {
    panel.series.push_back(LargestRadius(r, b, true, 1.0 / r.rig.ClearanceOf(b)));
    for (const double y : panel.series.back().y) largest = std::fmax(largest, y);
  }
  const double end_s = r.TimeOf(r.size() - 1);
  panel.series.push_back(Level("", 0.0, end_s, 0.3));
  panel.series.push_back(Level("", 0.0, end_s, 0.4));
  panel.series.push_back(Level("", 0.0, end_s, 0.5));
  panel.x_range = svg::Range{0.0, end_s};
  panel.y_range = {0.0, std::clamp(1.1 * largest, 0.62, 1.2)};
  return {"zones",
          "Displacement over clearance while the rotor was levitated. Below 0.3 is zone A, to 0.4 "
          "B, to 0.5 C, above D.",
          Wide(std::move(panel))};
}

NamedPicture SpeedPicture(const Recording& r) {
  svg::Panel panel{"speed", "time, s", "speed, rpm"};
  svg::Series series;
  ForBuckets(r, [&](std::size_t first, std::size_t) {
    series.x.push_back(r.TimeOf(first));
    series.y.push_back(RadPerSToRpm(static_cast<double>(r.speed_rad_per_s[first])));
  });
  const auto [least, most] = std::minmax_element(series.y.begin(), series.y.end());
  panel.x_range = svg::Range{0.0, r.TimeOf(r.size() - 1)};
  panel.y_range = svg::Range{std::min(0.0, 1.1 * *least), std::max(0.0, 1.1 * *most)};
  panel.series = {std::move(series)};
  return {"speed", "Speed of the rotor over time.", Wide(std::move(panel))};
}

/// Least and largest current of each bucket: the two edges of what the current did.
std::array<svg::Series, 2> CurrentEdges(const Recording& r, std::size_t axis) {
  std::array<svg::Series, 2> edges;
  for (svg::Series& edge : edges) {
    edge.colour = svg::Colour(axis % 2);
    edge.width = 1.0;
  }
  edges[0].name = r.rig.channels[axis];
  ForBuckets(r, [&](std::size_t first, std::size_t end) {
    const auto& current = r.current_a[axis];
    const auto at = [&](std::size_t i) { return current.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto [least, most] = std::minmax_element(at(first), at(end));
    edges[0].y.push_back(static_cast<double>(*most));
    edges[1].y.push_back(static_cast<double>(*least));
    for (svg::Series& edge : edges) edge.x.push_back(r.TimeOf(first));
  });
  return edges;
}

NamedPicture CurrentPicture(const Recording& r, std::size_t bearing) {
  const std::string& name = r.rig.bearings[bearing];
  svg::Panel panel{fmt::format("control current, {}", name), "time, s", "current, A"};
  const double limit_a =
      std::min(r.rig.bias_current_a, r.rig.max_coil_current_a - r.rig.bias_current_a);
  const double end_s = r.TimeOf(r.size() - 1);
  for (const std::size_t axis : {2 * bearing, 2 * bearing + 1}) {
    if (axis >= r.rig.axes()) continue;  // guided
    for (svg::Series& edge : CurrentEdges(r, axis)) panel.series.push_back(std::move(edge));
  }
  panel.series.push_back(Level("limit", 0.0, end_s, limit_a));
  panel.series.push_back(Level("", 0.0, end_s, -limit_a));
  panel.x_range = svg::Range{0.0, end_s};
  panel.y_range = {-1.4 * limit_a, 1.4 * limit_a};
  return {fmt::format("currents_{}", name),
          fmt::format("Least and largest control current of {} about the bias, per stretch of "
                      "time; dashed: what the coils can carry.",
                      name),
          Wide(std::move(panel))};
}

/// In lockstep the stamps are exact by construction and tell nothing.
NamedPicture SamplingPicture(const Recording& r) {
  Histogram intervals;
  for (std::size_t i = 1; i < r.size(); ++i) {
    if (r.cycle[i] == r.cycle[i - 1] + 1) {
      intervals.Add(r.sample_time_ns[i] - r.sample_time_ns[i - 1]);
    }
  }
  svg::Panel panel{"time between samples", "time, µs", "count"};
  panel.y_scale = svg::Scale::kLogarithmic;
  svg::Series series;
  series.mark = svg::Mark::kDot;
  series.width = 0.0;
  for (std::size_t bin = 0; bin < Histogram::kBins; ++bin) {
    if (intervals.bins()[bin] == 0) continue;
    series.x.push_back(Histogram::UpperEdge(bin) * 1e-3);
    series.y.push_back(static_cast<double>(intervals.bins()[bin]));
  }
  panel.series = {std::move(series)};
  return {"sampling", "How often each time between consecutive samples occurred, in bins of 4 %.",
          Wide(std::move(panel))};
}

}  // namespace

std::vector<NamedPicture> TimePictures(const Recording& recording) {
  std::vector<NamedPicture> pictures{DistancePicture(recording), ZonesPicture(recording)};
  for (std::size_t b = 0; b < recording.rig.bearings.size(); ++b) {
    pictures.push_back(CurrentPicture(recording, b));
  }
  return pictures;
}

std::vector<NamedPicture> ClockPictures(const Recording& recording) {
  std::vector<NamedPicture> pictures;
  if (recording.top_speed_rad_per_s > recording.standstill_rad_per_s) {
    pictures.push_back(SpeedPicture(recording));
  }
  if (recording.header.pace == "realtime") pictures.push_back(SamplingPicture(recording));
  return pictures;
}

}  // namespace levitas::report
