#include "report/session/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/problem.hpp"
#include "plant_sim/plant/train_model.hpp"

namespace levitas::report {
namespace {

constexpr std::size_t kMostOrbitPoints = 600;
constexpr double kStandingOrbitS = 0.1;
constexpr double kOneSpeed = 0.01;  // held speeds of two records that differ by less are one

analysis::SynchronousRequest RequestFor(const RecordToCompare& record,
                                        const std::vector<double>& orders) {
  analysis::SynchronousRequest request;
  request.orders = orders;
  request.standstill_rad_per_s = record.standstill_rad_per_s;
  request.axes_per_bearing = record.rig.numbers.axes() / record.rig.numbers.bearings.size();
  if (!record.rig.plant.shafts.empty()) {
    const std::vector<double> ratio = plant::SpeedRatios(record.rig.plant);
    for (const auto& bearing : record.rig.plant.bearings) {
      request.shaft_ratio.push_back(ratio[bearing.shaft]);
    }
  }
  return request;
}

Orbit OrbitOf(const session::Recording& recording, std::size_t bearing, std::size_t axes,
              const session::RowRange& rows) {
  Orbit orbit;
  const std::size_t step = (rows.end - rows.begin) / kMostOrbitPoints + 1;
  for (std::size_t row = rows.begin; row < rows.end; row += step) {
    orbit.x_m.push_back(recording.position_m[bearing * axes][row]);
    orbit.y_m.push_back(axes > 1 ? recording.position_m[bearing * axes + 1][row] : 0.0);
  }
  return orbit;
}

AtSpeed WithOrbits(const RecordToCompare& record, analysis::SynchronousRows found, bool standing) {
  const session::Recording& recording = record.recording;
  const double period_s = recording.period_s();
  AtSpeed made;
  made.from_s =
      static_cast<double>(recording.cycle[found.rows.begin] - recording.cycle.front()) * period_s;
  made.duration_s = static_cast<double>(found.rows.end - found.rows.begin) * period_s;
  const double shown_s =
      standing ? kStandingOrbitS : 4.0 * std::numbers::pi / found.speed_rad_per_s;
  const auto shown = static_cast<std::size_t>(std::ceil(shown_s / period_s)) + 1;
  const std::size_t all = found.rows.end - found.rows.begin;
  const session::RowRange rows{found.rows.end - std::min(shown, all), found.rows.end};
  const std::size_t axes = record.rig.numbers.axes() / record.rig.numbers.bearings.size();
  for (std::size_t b = 0; b < record.rig.numbers.bearings.size(); ++b) {
    made.orbits.push_back(OrbitOf(recording, b, axes, rows));
  }
  made.found = std::move(found);
  return made;
}

/// Each speed once, ascending.
std::vector<double> SpeedsOfAll(std::vector<double> held) {
  std::sort(held.begin(), held.end());
  const auto same = [](double one, double other) {
    return std::abs(other - one) <= kOneSpeed * other;
  };
  held.erase(std::unique(held.begin(), held.end(), same), held.end());
  return held;
}

void RefuseOtherChannels(const std::vector<RecordToCompare>& records) {
  const auto& first = records.front();
  for (const RecordToCompare& record : records) {
    if (record.rig.numbers.channels == first.rig.numbers.channels) continue;
    throw BadInput(fmt::format("{} has the channels {}, {} has {}: nothing to set side by side",
                               record.path, fmt::join(record.rig.numbers.channels, ", "),
                               first.path, fmt::join(first.rig.numbers.channels, ", ")));
  }
}

ComparedRecord ComparedAt(const RecordToCompare& record,
                          const analysis::SynchronousAnalysis& synchronous,
                          const std::vector<double>& speeds_rad_per_s) {
  ComparedRecord one{record.label,
                     record.path,
                     record.rig.numbers.name,
                     record.controller,
                     record.recording.damage,
                     {},
                     {}};
  for (const double speed : speeds_rad_per_s) {
    auto found = synchronous.At(speed);
    one.speeds.push_back(
        found ? std::optional(WithOrbits(record, std::move(*found), synchronous.Standing(speed)))
              : std::nullopt);
  }
  return one;
}

}  // namespace

Comparison Compare(const std::vector<RecordToCompare>& records, const ComparisonRequest& request) {
  RefuseOtherChannels(records);
  const RigNumbers& rig = records.front().rig.numbers;
  Comparison made;
  made.channels = rig.channels;
  made.bearings = rig.bearings;
  made.orders = request.orders;
  for (std::size_t b = 0; b < rig.bearings.size(); ++b) {
    made.clearance_m.push_back(rig.ClearanceOf(b));
  }
  std::vector<analysis::SynchronousAnalysis> analyses;
  std::vector<double> held;
  for (const RecordToCompare& record : records) {
    analyses.emplace_back(record.recording, RequestFor(record, request.orders));
    const auto& speeds = analyses.back().HeldSpeeds();
    held.insert(held.end(), speeds.begin(), speeds.end());
  }
  made.speeds_rad_per_s =
      request.speeds_rad_per_s.empty() ? SpeedsOfAll(std::move(held)) : request.speeds_rad_per_s;
  if (made.speeds_rad_per_s.empty()) {
    throw BadInput(
        "no record holds a speed for 0.2 s levitated and without a test signal; name speeds that "
        "are passed with --speeds");
  }
  for (std::size_t i = 0; i < records.size(); ++i) {
    ComparedRecord one = ComparedAt(records[i], analyses[i], made.speeds_rad_per_s);
    if (request.over_speed) one.over_speed = analyses[i].OverSpeed();
    made.records.push_back(std::move(one));
  }
  return made;
}

}  // namespace levitas::report
