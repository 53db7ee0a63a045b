#include "diagnosis/gain.hpp"

#include <algorithm>
#include <cmath>

#include "common/random.hpp"

namespace levitas::diagnosis {
namespace {

/// Sums over one block of samples.
struct Block {
  double nominal{}, calibrated{}, extended{}, noise{};  ///< in units of the noise's variance
};

double Square(float value) { return static_cast<double>(value) * static_cast<double>(value); }

bool Belongs(const Moment& m, Part part) { return part == Part::kFitted ? m.counts : m.held; }

std::vector<Block> Blocks(const RigView& rig, const ModelRuns& runs,
                          const std::vector<double>& noise_rms_m, Part part) {
  const auto length = static_cast<std::size_t>(0.05 / rig.period_s);
  std::vector<Block> blocks;
  for (std::size_t r = 0; r < runs.nominal.size(); ++r) {
    std::size_t filled = length;
    for (std::size_t n = 0; n < runs.nominal[r].moments.size(); ++n) {
      if (!Belongs(runs.nominal[r].moments[n], part)) continue;
      if (filled++ >= length) {
        blocks.emplace_back();
        filled = 1;
      }
      for (std::size_t a = 0; a < rig.axes; ++a) {
        const double weight = 1.0 / (noise_rms_m[a] * noise_rms_m[a]);
        blocks.back().nominal += weight * Square(runs.nominal[r].moments[n].innovation_m[a]);
        blocks.back().calibrated += weight * Square(runs.calibrated[r].moments[n].innovation_m[a]);
        blocks.back().extended += weight * Square(runs.extended[r].moments[n].innovation_m[a]);
        blocks.back().noise += 1.0;
      }
    }
  }
  return blocks;
}

struct Shares {
  double achieved, beyond;
};

double Share(double before, double after, double floor) {
  return before > floor ? std::clamp((before - after) / (before - floor), -1.0, 1.0) : 0.0;
}

Shares Of(const Block& sum) {
  return {Share(sum.nominal, sum.extended, sum.noise),
          Share(sum.calibrated, sum.extended, sum.noise)};
}

double Percent(const std::vector<Trajectory>& runs, std::size_t axis, double rms_m, Part part) {
  double sum = 0.0;
  double square = 0.0;
  double innovation = 0.0;
  double count = 0.0;
  for (const Trajectory& run : runs) {
    for (const Moment& m : run.moments) {
      if (!Belongs(m, part)) continue;
      sum += static_cast<double>(m.measured_m[axis]);
      square += Square(m.measured_m[axis]);
      innovation += Square(m.innovation_m[axis]);
      count += 1.0;
    }
  }
  const double variance = square - sum * sum / std::max(1.0, count);
  if (rms_m > 0.0) innovation = rms_m * rms_m * count;
  return variance > 0.0 ? 100.0 * (1.0 - std::sqrt(innovation / variance)) : 0.0;
}

}  // namespace

Gain MeasureGain(const RigView& rig, const ModelRuns& runs, const std::vector<double>& noise_rms_m,
                 Part part) {
  Gain gain;
  const double share = 1.0 / static_cast<double>(rig.axes);
  for (std::size_t a = 0; a < rig.axes; ++a) {
    gain.channel_nominal_percent.push_back(Percent(runs.nominal, a, 0.0, part));
    gain.channel_extended_percent.push_back(Percent(runs.extended, a, 0.0, part));
    gain.nominal_percent += share * gain.channel_nominal_percent.back();
    gain.extended_percent += share * gain.channel_extended_percent.back();
    gain.calibrated_percent += share * Percent(runs.calibrated, a, 0.0, part);
    gain.ceiling_percent += share * Percent(runs.extended, a, noise_rms_m[a], part);
  }
  const auto blocks = Blocks(rig, runs, noise_rms_m, part);
  if (blocks.empty()) return gain;
  const auto add = [](Block& to, const Block& from) {
    to.nominal += from.nominal;
    to.calibrated += from.calibrated;
    to.extended += from.extended;
    to.noise += from.noise;
  };
  Block total;
  for (const Block& block : blocks) add(total, block);
  gain.achieved = Of(total).achieved;
  gain.beyond_calibration = Of(total).beyond;
  constexpr std::size_t kDraws = 400;
  Random random(20261121);
  std::vector<double> achieved, beyond;
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    Block sum;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      add(sum, blocks[random.Bits() % blocks.size()]);
    }
    achieved.push_back(Of(sum).achieved);
    beyond.push_back(Of(sum).beyond);
  }
  std::sort(achieved.begin(), achieved.end());
  std::sort(beyond.begin(), beyond.end());
  const auto at = [](const std::vector<double>& sorted, double p) {
    return sorted[static_cast<std::size_t>(p * static_cast<double>(sorted.size()))];
  };
  gain.achieved_low = at(achieved, 0.05);
  gain.achieved_high = at(achieved, 0.95);
  gain.beyond_low = at(beyond, 0.05);
  gain.beyond_high = at(beyond, 0.95);
  return gain;
}

}  // namespace levitas::diagnosis
