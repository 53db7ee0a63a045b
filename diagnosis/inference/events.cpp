#include "diagnosis/inference/events.hpp"

#include <fmt/core.h>

#include <cmath>

#include "analysis/records/recorded_rows.hpp"
#include "diagnosis/model/repeated_frames.hpp"

namespace levitas::diagnosis {
namespace {

/// Lost frames that the rig file states, and as many again as chance may add: three deviations of a
/// sum of bursts.
double LostByFile(const RigView& rig, const LostFrames& frames) {
  double most = 0.0;
  for (const effect::EffectConfig& entry : rig.by_chance) {
    if (entry.id != effect::Id::kDroppedSamples) continue;
    const double burst = entry.values[1];
    const double lost = entry.values[0] * burst * static_cast<double>(frames.sent);
    most += lost + 3.0 * std::sqrt(lost * burst);
  }
  return most;
}

}  // namespace

LostFrames CountFrames(const RigView& rig, const std::vector<Record>& records) {
  LostFrames frames;
  for (const Record& record : records) {
    const bool repeats_are_lost = CountRepeats(record.rows, rig.axes).AreLost();
    bool within = false;
    for (std::size_t n = 1; n < record.rows.size(); ++n) {
      const auto& before = record.rows[n - 1];
      const auto& now = record.rows[n];
      if (!before.levitated || !now.levitated) continue;
      if (now.cycle > before.cycle + 1 + analysis::kMostLost) continue;
      const bool missing = now.cycle != before.cycle + 1;
      const bool repeated = (repeats_are_lost &&
                             Repeats(before.sample.position_m, now.sample.position_m, rig.axes)) ||
                            Repeats(before.sample.command.control_current_a,
                                    now.sample.command.control_current_a, rig.axes);
      ++frames.sent;
      const bool lost = missing || repeated;
      if (lost) ++frames.lost;
      if (lost && !within) ++frames.bursts;
      within = lost;
    }
  }
  return frames;
}

std::vector<Candidate> FindEvents(const RigView& rig, const std::vector<Record>& records,
                                  const Residual& residual) {
  std::vector<Candidate> found;
  constexpr double kPerFrame = 10.0;  // [nat] a repetition by chance, and a prior of one in ten
  const LostFrames frames = CountFrames(rig, records);
  const double unforeseen = static_cast<double>(frames.lost) - LostByFile(rig, frames);
  if (unforeseen > 0.0) {
    found.push_back({.effect = effect::Id::kDroppedSamples,
                     .place = fmt::format("{} frames", frames.lost),
                     .score = kPerFrame * (unforeseen - 1.0)});
  }
  double evidence = 0.0;
  std::string where;
  for (std::size_t a = 0; a < rig.axes && a < residual.channels.size(); ++a) {
    if (!(residual.channels[a].noise_rms_m > 0.0)) continue;
    const double off =
        std::log(residual.channels[a].noise_rms_m / rig.ReadingNoise(a)) / kNoiseTolerance;
    const double gain = 0.5 * off * off - std::log(10.0);
    if (gain < kDecisive) continue;
    evidence += gain;
    where += (where.empty() ? "" : ", ") + rig.numbers.channels[a];
  }
  if (evidence > 0.0) {
    found.push_back({.effect = effect::Id::kSensorNoise, .place = where, .score = evidence});
  }
  return found;
}

}  // namespace levitas::diagnosis
