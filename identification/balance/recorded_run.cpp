#include "identification/balance/recorded_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "session/exchange/csv_rows.hpp"
#include "session/exchange/mat_rows.hpp"

namespace levitas::balancing {
namespace {

constexpr std::size_t kLeastWindows = 8;
/// Below this share of the top speed a run-up says too little of what the rotor does there.
constexpr double kLeastShareOfTop = 0.2;

bool Turns(const session::Recording& record, double standstill_rad_per_s) {
  return std::ranges::any_of(record.speed_rad_per_s,
                             [&](double speed) { return std::abs(speed) > standstill_rad_per_s; });
}

/// At most so many windows of each narrow range of speed, evenly over the record: minutes at one
/// speed say no more than that, and cost as much as all the others.
std::vector<analysis::TrackedWindow> Thinned(std::vector<analysis::TrackedWindow> windows) {
  constexpr double kRanges = 120.0;
  constexpr std::size_t kMost = 6;
  double fastest = 0.0;
  for (const auto& window : windows) {
    fastest = std::max(fastest, std::abs(window.speed_rad_per_s));
  }
  const auto range_of = [&](const analysis::TrackedWindow& window) {
    return std::lround(kRanges * window.speed_rad_per_s / fastest);
  };
  std::map<long, std::size_t> count, seen;
  for (const auto& window : windows) ++count[range_of(window)];
  std::vector<analysis::TrackedWindow> kept;
  for (auto& window : windows) {
    const long range = range_of(window);
    const std::size_t all = count[range];
    const std::size_t at = seen[range]++;
    const std::size_t most = std::min(all, kMost);
    if (at * most / all != (at + 1) * most / all) kept.push_back(std::move(window));
  }
  return kept;
}

/// Sessions and logs of the bus hold the angle; of other files a column says so.
bool HasAngle(const std::string& path, const configuration::RigFile& rig) {
  const auto& channels = rig.numbers.channels;
  if (path.ends_with(".csv") || path.ends_with(".csv.xz")) {
    return session::CsvRows(path, channels).layout().Has(session::CsvQuantity::kAngle);
  }
  if (!path.ends_with(".mat")) return true;
  return session::MatRows(path, channels, rig.log.matrix, rig.log.rows)
      .layout()
      .Has(session::CsvQuantity::kAngle);
}

}  // namespace

RecordedRun ReadRun(const session::Recording& recording, const configuration::RigFile& rig) {
  analysis::OrderTrackRule rule;
  const auto refuse = [&recording](const std::string& why) {
    throw BadInput(fmt::format("{}: {}", recording.name, why));
  };
  if (!Turns(recording, rule.standstill_rad_per_s)) {
    refuse(
        "the rotor does not turn in this record; balancing needs a run-up with recorded speed "
        "and angle");
  }
  RecordedRun run{recording.name, analysis::TrackOrder(recording, rule), 0.0, {}};
  if (run.windows.size() < kLeastWindows) {
    refuse(fmt::format(
        "only {} stretches of six turns without clipping, gaps or currents beyond the limit, "
        "needed {}: record the run-up of the levitated rotor from start to end",
        run.windows.size(), kLeastWindows));
  }
  double fastest = 0.0;
  for (const auto& window : run.windows) {
    fastest = std::max(fastest, std::abs(window.speed_rad_per_s));
  }
  if (fastest < kLeastShareOfTop * rig.numbers.max_speed_rad_per_s) {
    refuse(
        fmt::format("reaches {:.0f} rpm, a fifth of the rig's {:.0f} rpm is the least that says "
                    "anything of its response there",
                    RadPerSToRpm(fastest), RadPerSToRpm(rig.numbers.max_speed_rad_per_s)));
  }
  run.windows = Thinned(std::move(run.windows));
  if (!recording.bias_current_a.empty()) run.bias_current_a = recording.bias_current_a.back();
  return run;
}

RecordedRun LoadRun(const std::string& path, const configuration::RigFile& rig) {
  if (!HasAngle(path, rig)) {
    throw BadInput(
        path +
        ": has no column rotor_angle_rad: without the angle of the rotor a weight has no "
        "place; record the angle, as of a key phasor");
  }
  return ReadRun(session::LoadRecording(path, rig), rig);
}

}  // namespace levitas::balancing
