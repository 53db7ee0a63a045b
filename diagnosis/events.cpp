#include "diagnosis/events.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace levitas::diagnosis {
namespace {

bool SameOnAllAxes(const AxisArray& a, const AxisArray& b, std::size_t axes) {
  return std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(axes), b.begin());
}

/// More in a row are no loss but a pause: another flight, or rows that were left out.
constexpr std::uint64_t kMostLost = 20;

std::size_t LostFrames(const RigView& rig, const std::vector<Record>& records) {
  std::size_t lost = 0;
  for (const Record& record : records) {
    for (std::size_t n = 1; n < record.rows.size(); ++n) {
      const auto& before = record.rows[n - 1];
      const auto& now = record.rows[n];
      if (!before.levitated || !now.levitated) continue;
      if (now.cycle > before.cycle + 1 + kMostLost) continue;
      const bool missing = now.cycle != before.cycle + 1;
      const bool repeated =
          SameOnAllAxes(before.sample.position_m, now.sample.position_m, rig.axes) ||
          SameOnAllAxes(before.sample.command.control_current_a,
                        now.sample.command.control_current_a, rig.axes);
      if (missing || repeated) ++lost;
    }
  }
  return lost;
}

}  // namespace

std::vector<Candidate> FindEvents(const RigView& rig, const std::vector<Record>& records,
                                  const Remainder& remainder) {
  std::vector<Candidate> found;
  constexpr double kPerFrame = 10.0;  // [nat] a repetition by chance, and a prior of one in ten
  if (const std::size_t lost = LostFrames(rig, records); lost > 0) {
    found.push_back({.effect = "dropped_samples",
                     .place = fmt::format("{} frames", lost),
                     .score = kPerFrame * static_cast<double>(lost) - kPerFrame});
  }
  double evidence = 0.0;
  std::string where;
  for (std::size_t a = 0; a < rig.axes && a < remainder.channels.size(); ++a) {
    const auto& sensor = rig.bearing(a).sensor;
    if (!(remainder.channels[a].noise_rms_m > 0.0)) continue;
    const double off =
        std::log(remainder.channels[a].noise_rms_m / analysis::ReadingNoise(sensor)) /
        kNoiseTolerance;
    const double gain = 0.5 * off * off - std::log(10.0);
    if (gain < kDecisive) continue;
    evidence += gain;
    where += (where.empty() ? "" : ", ") + rig.numbers.channels[a];
  }
  if (evidence > 0.0) {
    found.push_back({.effect = "sensor_noise", .place = where, .score = evidence});
  }
  return found;
}

}  // namespace levitas::diagnosis
