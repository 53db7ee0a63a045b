#include "diagnosis/inference/forecast_interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/random.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kNoisesOfADraw = 25;

double SquareOf(double value) { return value * value; }

/// Blocks of the fitted records, by record.
class Noise {
 public:
  Noise(const std::vector<NoiseBlock>& blocks, std::size_t axes) : axes_(axes) {
    for (const NoiseBlock& block : blocks) {
      if (block.record >= records_.size()) records_.resize(block.record + 1);
      records_[block.record].push_back(&block.square_m2);
    }
    std::erase_if(records_, [](const auto& record) { return record.empty(); });
  }
  [[nodiscard]] std::size_t records() const { return records_.size(); }
  /// Mean square per axis over `count` blocks of one record, drawn with replacement.
  [[nodiscard]] std::vector<double> Draw(std::size_t record, std::size_t count,
                                         Random& random) const {
    std::vector<double> mean(axes_, 0.0);
    const auto& blocks = records_[record];
    for (std::size_t i = 0; i < count; ++i) {
      const std::vector<double>& block = *blocks[random.Bits() % blocks.size()];
      for (std::size_t a = 0; a < axes_; ++a) mean[a] += block[a] / static_cast<double>(count);
    }
    return mean;
  }

 private:
  std::size_t axes_;
  std::vector<std::vector<const std::vector<double>*>> records_;
};

/// What is left of all bands, per axis, and how they add up.
struct Left {
  std::vector<double> left_m2, motion_m2;
  double rows{};

  explicit Left(std::size_t axes) : left_m2(axes, 0.0), motion_m2(axes, 0.0) {}
  void Add(const BandSums& band, const std::vector<double>& left) {
    for (std::size_t a = 0; a < left_m2.size(); ++a) {
      left_m2[a] += left[a];
      motion_m2[a] += band.motion_m2[a];
    }
    rows += static_cast<double>(band.rows);
  }
  [[nodiscard]] double Rms() const {
    double sum = 0.0;
    for (const double left : left_m2) sum += left;
    return std::sqrt(sum / (rows * static_cast<double>(left_m2.size())));
  }
  [[nodiscard]] double FitPercent() const {
    double fit = 0.0;
    for (std::size_t a = 0; a < left_m2.size(); ++a) {
      if (motion_m2[a] > 0.0) fit += 100.0 * (1.0 - std::sqrt(left_m2[a] / motion_m2[a]));
    }
    return fit / static_cast<double>(left_m2.size());
  }
};

struct Drawn {
  std::vector<double> residual_m, fit_percent;
  void Add(const Left& left) {
    residual_m.push_back(left.Rms());
    fit_percent.push_back(left.FitPercent());
  }
};

/// From the 5th to the 95th percentile; the values need not be sorted.
Interval Middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&values](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const auto above = std::min(below + 1, values.size() - 1);
    // Infinite values have no mean.
    if (!std::isfinite(values[above]) || !std::isfinite(values[below])) return values[below];
    return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
  };
  return {at(0.05), at(0.95)};
}

/// Whether the model foretells the record better than the file, were the rig this draw.
bool BetterThanFile(const std::vector<BandSums>& bands, std::size_t draw,
                    const std::vector<double>& noise_m2) {
  const std::size_t axes = noise_m2.size();
  Left model(axes);
  Left file(axes);
  for (const BandSums& band : bands) {
    std::vector<double> left = band.apart_m2[draw];
    std::vector<double> left_by_file = band.apart_from_file_m2[draw];
    for (std::size_t a = 0; a < axes; ++a) {
      left[a] += static_cast<double>(band.rows) * noise_m2[a];
      left_by_file[a] += static_cast<double>(band.rows) * noise_m2[a];
    }
    model.Add(band, left);
    file.Add(band, left_by_file);
  }
  return model.FitPercent() > file.FitPercent();
}

double ChanceToBeBetter(const std::vector<BandSums>& bands, const std::vector<NoiseBlock>& noise) {
  const std::size_t draws = bands.front().apart_from_file_m2.size();
  if (draws == 0) return 0.0;
  std::vector<double> mean(bands.front().motion_m2.size(), 0.0);
  for (const NoiseBlock& block : noise) {
    for (std::size_t a = 0; a < mean.size(); ++a) {
      mean[a] += block.square_m2[a] / static_cast<double>(noise.size());
    }
  }
  double better = 0.0;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    better += BetterThanFile(bands, draw, mean) ? 1.0 : 0.0;
  }
  return better / static_cast<double>(draws);
}

/// One draw of what the model leaves of a band.
std::vector<double> Leave(const BandSums& band, const std::vector<double>& apart_m2,
                          const std::vector<double>& noise_m2, const std::vector<double>& error,
                          Random& random) {
  const auto rows = static_cast<double>(band.rows);
  std::vector<double> left(noise_m2.size());
  for (std::size_t a = 0; a < left.size(); ++a) {
    const double apart =
        std::isfinite(apart_m2[a]) ? apart_m2[a] : std::numeric_limits<double>::infinity();
    const double far_m2 = apart + SquareOf(error[a]) * band.motion_m2[a];
    const double along = 2.0 * std::sqrt(noise_m2[a] * far_m2) * random.Normal();
    left[a] = std::isfinite(far_m2) ? std::max(0.0, rows * noise_m2[a] + far_m2 + along) : far_m2;
  }
  return left;
}

/// By speed, what was foretold beside what was measured; returns the sum of the latter.
Left CompareBands(const std::vector<BandSums>& bands, const std::vector<Drawn>& parts,
                  Forecast& forecast) {
  const std::size_t axes = bands.front().motion_m2.size();
  Left measured(axes);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    Left alone(axes);
    alone.Add(bands[b], bands[b].left_m2);
    measured.Add(bands[b], bands[b].left_m2);
    forecast.by_speed.push_back({bands[b].from_rad_per_s, bands[b].to_rad_per_s,
                                 Middle(parts[b].residual_m), alone.Rms(),
                                 Middle(parts[b].fit_percent), alone.FitPercent()});
  }
  return measured;
}

}  // namespace

Forecast IntervalsOf(const std::vector<BandSums>& bands, const std::vector<NoiseBlock>& noise,
                     std::size_t block_rows, double model_error_share) {
  Forecast forecast;
  if (bands.empty() || bands.front().apart_m2.empty() || noise.empty()) return forecast;
  const std::size_t axes = bands.front().motion_m2.size();
  const std::size_t draws = bands.front().apart_m2.size();
  const Noise blocks(noise, axes);
  Random random(20261127);
  Drawn whole;
  std::vector<Drawn> parts(bands.size());
  for (std::size_t draw = 0; draw < kNoisesOfADraw * draws; ++draw) {
    const std::size_t record = random.Bits() % blocks.records();
    const double level = std::exp(kLevelShare * random.Normal());
    std::vector<double> error(axes);
    for (double& share : error) share = model_error_share * random.Normal();
    Left all(axes);
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const std::size_t count = std::max<std::size_t>(1, bands[b].rows / block_rows);
      std::vector<double> drawn_m2 = blocks.Draw(record, count, random);
      for (double& square : drawn_m2) square *= level;
      const auto left = Leave(bands[b], bands[b].apart_m2[draw % draws], drawn_m2, error, random);
      Left alone(axes);
      alone.Add(bands[b], left);
      parts[b].Add(alone);
      all.Add(bands[b], left);
    }
    whole.Add(all);
  }
  const Left measured = CompareBands(bands, parts, forecast);
  forecast.better_than_file = ChanceToBeBetter(bands, noise);
  forecast.fit_percent = Middle(whole.fit_percent);
  forecast.fit_measured_percent = measured.FitPercent();
  forecast.residual_m = Middle(whole.residual_m);
  forecast.residual_measured_m = measured.Rms();
  return forecast;
}

}  // namespace levitas::diagnosis
