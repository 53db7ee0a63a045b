#include "diagnosis/inference/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/each_in_parallel.hpp"
#include "common/random.hpp"
#include "diagnosis/inference/fit_gain.hpp"

namespace levitas::diagnosis {
namespace {

double PowerOf(double value) { return value * value; }

/// Speeds of the samples that count, cut into bands.
class Bands {
 public:
  Bands(const std::vector<Trajectory>& runs, std::size_t axes) : axes_(axes) {
    double fastest = 0.0;
    lowest_ = std::numeric_limits<double>::infinity();
    std::vector<double> sum(axes, 0.0);
    double count = 0.0;
    for (const Trajectory& run : runs) {
      for (const SamplePoint& m : run.moments) {
        if (!m.counts) continue;
        const double speed = std::abs(static_cast<double>(m.speed_rad_per_s));
        fastest = std::max(fastest, speed);
        lowest_ = std::min(lowest_, speed);
        for (std::size_t a = 0; a < axes; ++a) sum[a] += static_cast<double>(m.measured_m[a]);
        count += 1.0;
      }
    }
    for (const double s : sum) mean_m_.push_back(s / std::max(1.0, count));
    constexpr double kSameSpeed = 0.05;
    const bool varies = fastest - lowest_ > kSameSpeed * fastest + 1.0;
    const std::size_t number = varies ? kSpeedBands : 1;
    width_ = (fastest - lowest_) / static_cast<double>(number);
    for (std::size_t b = 0; b < number && count > 0.0; ++b) {
      BandSums band;
      band.from_rad_per_s = lowest_ + width_ * static_cast<double>(b);
      band.to_rad_per_s = lowest_ + width_ * static_cast<double>(b + 1);
      band.motion_m2.assign(axes, 0.0);
      band.left_m2.assign(axes, 0.0);
      sums.push_back(std::move(band));
    }
    for (const Trajectory& run : runs) Add(run);
  }

  [[nodiscard]] std::size_t Of(const SamplePoint& m) const {
    const double above = std::abs(static_cast<double>(m.speed_rad_per_s)) - lowest_;
    const auto band = width_ > 0.0 ? static_cast<std::size_t>(std::max(0.0, above / width_)) : 0;
    return std::min(band, sums.size() - 1);
  }

  std::vector<BandSums> sums;

 private:
  void Add(const Trajectory& run) {
    for (const SamplePoint& m : run.moments) {
      if (!m.counts) continue;
      BandSums& band = sums[Of(m)];
      ++band.rows;
      for (std::size_t a = 0; a < axes_; ++a) {
        band.motion_m2[a] += PowerOf(static_cast<double>(m.measured_m[a]) - mean_m_[a]);
        band.left_m2[a] += PowerOf(static_cast<double>(m.innovation_m[a]));
      }
    }
  }

  std::size_t axes_;
  double lowest_{}, width_{};
  std::vector<double> mean_m_;
};

/// Numbers of a rig that the fitted records take for as likely as their spread says.
Point Draw(const std::vector<Term>& terms, const SearchResult& answer, Random& random) {
  Eigen::VectorXd normal(answer.spread.cols());
  for (double& value : normal) value = random.Normal();
  const Eigen::VectorXd change = answer.spread * normal;
  Point drawn = answer.extended;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const double moved = change[static_cast<Eigen::Index>(i)];
    double& theta = drawn.theta[i];
    if (moved != 0.0) theta = std::max(theta + moved, LeastPossible(terms[i]));
  }
  return drawn;
}

/// Per band and axis: squared distance of two predictions of the same readings.
std::vector<std::vector<double>> Apart(const Bands& bands, const std::vector<Trajectory>& model,
                                       const std::vector<Trajectory>& draw, std::size_t axes) {
  std::vector<std::vector<double>> apart(bands.sums.size(), std::vector<double>(axes, 0.0));
  for (std::size_t r = 0; r < model.size(); ++r) {
    for (std::size_t n = 0; n < model[r].moments.size(); ++n) {
      const SamplePoint& m = model[r].moments[n];
      if (!m.counts) continue;
      std::vector<double>& sum = apart[bands.Of(m)];
      for (std::size_t a = 0; a < axes; ++a) {
        sum[a] += PowerOf(static_cast<double>(draw[r].moments[n].innovation_m[a]) -
                          static_cast<double>(m.innovation_m[a]));
      }
    }
  }
  return apart;
}

std::vector<NoiseBlock> BlocksOf(const std::vector<Trajectory>& fitted, std::size_t axes,
                                 std::size_t rows) {
  std::vector<NoiseBlock> blocks;
  for (std::size_t r = 0; r < fitted.size(); ++r) {
    std::size_t filled = 0;
    NoiseBlock block{r, std::vector<double>(axes, 0.0)};
    for (const SamplePoint& m : fitted[r].moments) {
      if (!m.counts) continue;
      for (std::size_t a = 0; a < axes; ++a) {
        block.square_m2[a] +=
            PowerOf(static_cast<double>(m.innovation_m[a])) / static_cast<double>(rows);
      }
      if (++filled < rows) continue;
      blocks.push_back(block);
      block.square_m2.assign(axes, 0.0);
      filled = 0;
    }
  }
  return blocks;
}

}  // namespace

Forecast Foretell(const Search& search, const std::vector<Term>& terms, const SearchResult& answer,
                  const std::vector<Trajectory>& fitted, const std::vector<Record>& validation,
                  const Judging& judging) {
  const std::size_t axes = search.rig().axes;
  const std::vector<Record> records = Spans(validation, kForecastRows, search.rig().period_s);
  const Gains gains = search.DesignGains(records, answer.speed);
  const std::vector<Trajectory> model = search.Run(records, gains, answer.extended);
  const std::vector<Trajectory> file =
      search.Run(records, gains, PointAt(terms, std::vector<double>(terms.size(), 0.0)));
  Bands bands(model, axes);
  if (bands.sums.empty()) return {};
  Random random(20261128);
  std::vector<Point> drawn;
  for (std::size_t i = 0; i < kForecastDraws; ++i) drawn.push_back(Draw(terms, answer, random));
  std::vector<std::vector<std::vector<double>>> apart(drawn.size());
  auto from_file = apart;
  EachInParallel(drawn.size(), 0, [&](std::size_t i) {
    const auto draw = search.RunAlone(records, gains, drawn[i]);
    apart[i] = Apart(bands, model, draw, axes);
    from_file[i] = Apart(bands, file, draw, axes);
  });
  for (std::size_t b = 0; b < bands.sums.size(); ++b) {
    for (const auto& draw : apart) bands.sums[b].apart_m2.push_back(draw[b]);
    for (const auto& draw : from_file) bands.sums[b].apart_from_file_m2.push_back(draw[b]);
  }
  const std::size_t block_rows = BlockRows(search.rig());
  std::erase_if(bands.sums,
                [block_rows](const BandSums& band) { return 2 * band.rows < block_rows; });
  return IntervalsOf(bands.sums, BlocksOf(fitted, axes, block_rows), block_rows,
                     judging.model_error_share);
}

}  // namespace levitas::diagnosis
