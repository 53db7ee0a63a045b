#include "identification/frf/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <span>

#include "common/problem.hpp"
#include "identification/frf/flat_top.hpp"

namespace levitas::identification {
namespace {

/// Share of samples at a limit from which on a response is no longer that of the rig.
constexpr double kClippedShare = 1e-3;
/// The same of samples at one value that is not the range's: a few may be chance.
constexpr double kFlatShare = 5e-3;
/// A limited command is recorded as it was given, so that it only wastes excitation.
constexpr double kLimitedShare = 0.02;
/// Below this frequency the shipped rigs, and any rotor worth calling one, move as a rigid body.
constexpr double kRigidLowHz = 15.0;
constexpr double kRigidHighHz = 45.0;
/// Above this frequency no position loop of a magnetic bearing answers.
constexpr double kBeyondLoopHz = 2000.0;

using Problems = std::vector<std::string>;

void CheckChannel(const session::Recording& record, const Experiment& e, std::size_t channel,
                  Problems& problems) {
  const session::Column& position_m = record.position_m[channel];
  const session::Column& current_a = record.current_a[channel];
  std::set<double> values;
  std::size_t clipped = 0;
  std::size_t saturated = 0;
  for (std::size_t row = e.begin; row < e.end(); ++row) {
    if (values.size() < 4) values.insert(position_m[row]);
    if (std::abs(position_m[row]) >= 0.999 * record.sensor_range_m[channel]) ++clipped;
    if (std::abs(current_a[row]) >= 0.9999 * record.current_limit_a) ++saturated;
  }
  const auto rows = static_cast<double>(e.end() - e.begin);
  const std::string& name = record.channels[channel];
  const std::string& excited = record.channels[e.axis];
  if (values.size() < 4) {
    problems.push_back(fmt::format(
        "position {} is dead ({} different values) while {} is excited: check probe and cable",
        name, values.size(), excited));
  }
  if (static_cast<double>(clipped) > kClippedShare * rows) {
    problems.push_back(fmt::format(
        "position {} is clipped at the sensor's range ({:.4g} um) in {:.1f} % of the samples while "
        "{} is excited, allowed {:g} %: use a smaller amplitude",
        name, 1e6 * record.sensor_range_m[channel], 100.0 * static_cast<double>(clipped) / rows,
        excited, 100.0 * kClippedShare));
  } else if (values.size() >= 4) {
    const double flat = FlatShare(std::span(position_m).subspan(e.begin, e.end() - e.begin));
    if (flat > kFlatShare) {
      problems.push_back(fmt::format(
          "position {} is cut off below the sensor's range in {:.1f} % of the samples while {} is "
          "excited, allowed {:g} %: check amplifier and converter, or use a smaller amplitude",
          name, 100.0 * flat, excited, 100.0 * kFlatShare));
    }
  }
  if (static_cast<double>(saturated) > kLimitedShare * rows) {
    problems.push_back(fmt::format(
        "control current {} is at its limit ({:.4g} A) in {:.1f} % of the samples while {} is "
        "excited, allowed {:g} %: use a smaller amplitude",
        name, record.current_limit_a, 100.0 * static_cast<double>(saturated) / rows, excited,
        100.0 * kLimitedShare));
  }
}

void Refuse(const std::string& name, const Problems& problems) {
  if (problems.empty()) return;
  std::string text = name + ": not usable for identification";
  for (const std::string& problem : problems) text += "\n  " + problem;
  throw BadInput(text);
}

}  // namespace

void RefuseBadSignals(const session::Recording& record,
                      const std::vector<Experiment>& experiments) {
  Problems problems;
  for (std::size_t channel = 0; channel < record.axes(); ++channel) {
    // One sentence per channel: the first experiment that shows the defect.
    for (const Experiment& experiment : experiments) {
      const std::size_t before = problems.size();
      CheckChannel(record, experiment, channel, problems);
      if (problems.size() != before) break;
    }
  }
  Refuse(record.name, problems);
}

void RefuseWrongSigns(const FrequencyResponse& response, double delay_s) {
  Problems problems;
  const std::complex<double> j(0.0, 1.0);
  for (std::size_t axis = 0; axis < response.channels.size(); ++axis) {
    const auto at = static_cast<Eigen::Index>(axis);
    double push = 0.0;
    double follow = 0.0;
    for (std::size_t line = 0; line < response.frequency_hz.size(); ++line) {
      const double f = response.frequency_hz[line];
      if (f > kBeyondLoopHz) follow += response.sensitivity[line](at, at).real();
      if (f < kRigidLowHz || f > kRigidHighHz) continue;
      const auto advance = std::exp(j * (2.0 * std::numbers::pi * f * delay_s));
      // Each line by its own size, so that no single one decides.
      const auto value = response.plant[line](at, at) * advance;
      push += value.real() / std::max(std::abs(value), 1e-300);
    }
    if (follow < 0.0) {
      problems.push_back(fmt::format(
          "the control current {} follows its excitation with the wrong sign: negate one of the "
          "two columns",
          response.channels[axis]));
    } else if (push > 0.0) {
      problems.push_back(fmt::format(
          "{} moves with the current where a free rotor moves against it ({:.0f} to {:.0f} Hz): "
          "probe or coil polarity is wrong in the rig file or in the record",
          response.channels[axis], kRigidLowHz, kRigidHighHz));
    }
  }
  Refuse("frequency response", problems);
}

}  // namespace levitas::identification
