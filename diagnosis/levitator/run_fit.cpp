#include "diagnosis/levitator/run_fit.hpp"

#include <algorithm>
#include <cmath>

#include "common/random.hpp"

namespace levitas::levitator {
namespace {

/// Sums of squares of an error and of its reference, over a stretch of time.
struct Block {
  double error{}, reference{}, noise{};

  void Add(const Block& other) {
    error += other.error;
    reference += other.reference;
    noise += other.noise;
  }
};

double Percent(const Block& sum) {
  return sum.reference > 0.0 ? 100.0 * (1.0 - std::sqrt(sum.error / sum.reference)) : 0.0;
}

double Share(const Block& sum) {
  const double possible = sum.reference - sum.noise;
  return possible > 0.0 ? 100.0 * (sum.reference - sum.error) / possible : 0.0;
}

template <class Measure>
Fit Bootstrap(const std::vector<Block>& blocks, Measure measure) {
  constexpr std::size_t kDraws = 400;
  if (blocks.empty()) return {};
  Random random(20261121);
  Block total;
  for (const Block& block : blocks) total.Add(block);
  std::vector<double> drawn;
  drawn.reserve(kDraws);
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    Block sum;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      sum.Add(blocks[random.Bits() % blocks.size()]);
    }
    drawn.push_back(measure(sum));
  }
  std::sort(drawn.begin(), drawn.end());
  return {measure(total), drawn[kDraws / 20], drawn[kDraws - kDraws / 20]};
}

double Mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double Square(double value) { return value * value; }

std::vector<Block> BlocksOf(const std::vector<double>& error, const std::vector<double>& reference,
                            double mean, double noise, double period_s) {
  const auto length = static_cast<std::size_t>(std::max(1.0, 0.5 / period_s));
  std::vector<Block> blocks;
  for (std::size_t n = 0; n < error.size(); ++n) {
    if (n % length == 0) blocks.emplace_back();
    blocks.back().Add({Square(error[n]), Square(reference[n] - mean), Square(noise)});
  }
  return blocks;
}

Fit FitAgainst(const std::vector<double>& error, const std::vector<double>& measured,
               double period_s) {
  return Bootstrap(BlocksOf(error, measured, Mean(measured), 0.0, period_s), Percent);
}

}  // namespace

double WhiteNoise(const std::vector<double>& signal) {
  // White noise of unit variance gives 1 + 16 + 36 + 16 + 1 = 70, and what lies below a fiftieth of
  // the sampling rate next to nothing.
  if (signal.size() < 5) return 0.0;
  double sum = 0.0;
  for (std::size_t n = 4; n < signal.size(); ++n) {
    sum += Square(signal[n] - 4.0 * signal[n - 1] + 6.0 * signal[n - 2] - 4.0 * signal[n - 3] +
                  signal[n - 4]);
  }
  return std::sqrt(sum / 70.0 / static_cast<double>(signal.size() - 4));
}

double Ceiling(const std::vector<double>& measured, double noise) {
  const double mean = Mean(measured);
  Block sum;
  for (const double value : measured) sum.Add({Square(noise), Square(value - mean), 0.0});
  return Percent(sum);
}

Fit SharePercent(const std::vector<double>& before, const std::vector<double>& after, double noise,
                 double period_s) {
  return Bootstrap(BlocksOf(after, before, 0.0, noise, period_s), Share);
}

Errors ErrorsOf(const NominalRig& rig, const Series& series, const Theta& theta,
                std::size_t record) {
  const CoilRun coils = RunCoils(rig, series, theta, record);
  const std::vector<double> innovation = Innovations(rig, series, theta, record, coils);
  Errors out;
  for (std::size_t n = 0; n < series.size(); ++n) {
    if (!series.counts[n]) continue;
    for (std::size_t coil = 0; coil < 2 && series.has_currents(); ++coil) {
      out.measured_a[coil].push_back(series.measured_a[coil][n]);
      out.current_a[coil].push_back(series.measured_a[coil][n] - coils.reading_a[coil][n]);
    }
    out.position_m.push_back(series.position_m[n]);
    out.motion_m.push_back(innovation[n]);
  }
  return out;
}

RunFit FitOf(const Errors& errors, double period_s) {
  return {FitAgainst(errors.current_a[0], errors.measured_a[0], period_s),
          FitAgainst(errors.current_a[1], errors.measured_a[1], period_s),
          FitAgainst(errors.motion_m, errors.position_m, period_s)};
}

}  // namespace levitas::levitator
