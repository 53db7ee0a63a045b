#include "diagnosis/inference/gain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/random.hpp"

namespace levitas::diagnosis {
namespace {

/// Squared innovations of one axis over one block, in units of its noise's variance.
struct Sums {
  double nominal{}, calibrated{}, extended{}, noise{};

  void Add(const Sums& other) {
    nominal += other.nominal;
    calibrated += other.calibrated;
    extended += other.extended;
    noise += other.noise;
  }
};
using Block = std::array<Sums, kMaxAxes>;

double Square(float value) { return static_cast<double>(value) * static_cast<double>(value); }

bool Belongs(const SamplePoint& m, Part part) { return part == Part::kFitted ? m.counts : m.held; }

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
        blocks.back()[a].Add({weight * Square(runs.nominal[r].moments[n].innovation_m[a]),
                              weight * Square(runs.calibrated[r].moments[n].innovation_m[a]),
                              weight * Square(runs.extended[r].moments[n].innovation_m[a]), 1.0});
      }
    }
  }
  return blocks;
}

double GainedShare(double before, double after, double floor) {
  return before > floor ? std::clamp((before - after) / (before - floor), -1.0, 1.0) : 0.0;
}

double OverNoise(double squared, const Sums& all) {
  return all.noise > 0.0 ? squared / all.noise : 0.0;
}

/// All shares of one draw: whole, beyond calibration, what there is to gain, then every axis.
std::vector<double> SharesOf(const Block& block, std::size_t axes) {
  Sums all;
  for (std::size_t a = 0; a < axes; ++a) all.Add(block[a]);
  std::vector<double> shares{GainedShare(all.nominal, all.extended, all.noise),
                             GainedShare(all.calibrated, all.extended, all.noise),
                             OverNoise(all.nominal, all) - 1.0};
  for (std::size_t a = 0; a < axes; ++a) {
    shares.push_back(GainedShare(block[a].nominal, block[a].extended, block[a].noise));
  }
  return shares;
}

void AddTo(Block& to, const Block& from, std::size_t axes) {
  for (std::size_t a = 0; a < axes; ++a) to[a].Add(from[a]);
}

/// Value and 5 to 95 % of every share.
std::vector<Share> Bootstrap(const std::vector<Block>& blocks, std::size_t axes) {
  constexpr std::size_t kDraws = 400;
  Random random(20261121);
  Block total{};
  for (const Block& block : blocks) AddTo(total, block, axes);
  const std::vector<double> values = SharesOf(total, axes);
  std::vector<std::vector<double>> drawn(values.size());
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    Block sum{};
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      AddTo(sum, blocks[random.Bits() % blocks.size()], axes);
    }
    const std::vector<double> shares = SharesOf(sum, axes);
    for (std::size_t i = 0; i < shares.size(); ++i) drawn[i].push_back(shares[i]);
  }
  std::vector<Share> out;
  out.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::sort(drawn[i].begin(), drawn[i].end());
    out.push_back({values[i], drawn[i][kDraws / 20], drawn[i][kDraws - kDraws / 20]});
  }
  return out;
}

double Percent(const std::vector<Trajectory>& runs, std::size_t axis, double rms_m, Part part) {
  double sum = 0.0;
  double square = 0.0;
  double innovation = 0.0;
  double count = 0.0;
  for (const Trajectory& run : runs) {
    for (const SamplePoint& m : run.moments) {
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
  const std::vector<Share> shares = Bootstrap(blocks, rig.axes);
  gain.achieved = shares[0];
  gain.beyond_calibration = shares[1];
  gain.to_gain = shares[2];
  gain.channel.assign(shares.begin() + 3, shares.end());
  Sums all;
  for (const Block& block : blocks) {
    for (std::size_t a = 0; a < rig.axes; ++a) all.Add(block[a]);
  }
  gain.calibrated_over_noise = OverNoise(all.calibrated, all);
  gain.extended_over_noise = OverNoise(all.extended, all);
  return gain;
}

}  // namespace levitas::diagnosis
