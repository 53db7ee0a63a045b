// A forecast whose truth is known: y[n] = theta x[n] + noise, theta known to a normal distribution.

#include "diagnosis/inference/forecast_interval.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/random.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kRows = 1000;
constexpr std::size_t kBlockRows = 100;
constexpr double kMean = 1.0;
constexpr double kScatter = 0.3;

struct Toy {
  std::vector<BandSums> bands;
  std::vector<NoiseBlock> noise;
};

double SquareOf(double value) { return value * value; }

/// Two bands of speed; the second has three times the motion. The file says `file`.
Toy DrawToy(std::uint64_t seed, double truth, double file, int draws = 60) {
  Random random(seed);
  Toy toy;
  for (int block = 0; block < 60; ++block) {
    double sum = 0.0;
    for (std::size_t n = 0; n < kBlockRows; ++n) sum += SquareOf(random.Normal());
    toy.noise.push_back({0, {sum / static_cast<double>(kBlockRows)}});
  }
  std::vector<double> thetas;
  for (int j = 0; j < draws; ++j) thetas.push_back(kMean + kScatter * random.Normal());
  for (const double size : {1.0, 3.0}) {
    BandSums band{100.0 * size, 200.0 * size, kRows, {0.0}, {0.0}, {}, {}};
    double power = 0.0;
    for (std::size_t n = 0; n < kRows; ++n) {
      const double x = size * random.Normal();
      const double y = truth * x + random.Normal();
      power += x * x;
      band.motion_m2[0] += y * y;
      band.left_m2[0] += SquareOf(y - kMean * x);
    }
    for (const double theta : thetas) {
      band.apart_m2.push_back({SquareOf(theta - kMean) * power});
      band.apart_from_file_m2.push_back({SquareOf(theta - file) * power});
    }
    toy.bands.push_back(band);
  }
  return toy;
}

Forecast IntervalsOfToy(const Toy& toy) {
  return IntervalsOf(toy.bands, toy.noise, kBlockRows, 0.0);
}

TEST(ForecastInterval, CoversATruthOfThePosteriorAsOftenAsItSays) {
  constexpr int kTrials = 300;
  Random random(41);
  int covered = 0;
  int bands = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double truth = kMean + kScatter * random.Normal();
    const Forecast forecast =
        IntervalsOfToy(DrawToy(1000 + static_cast<std::uint64_t>(trial), truth, 2.0));
    covered += forecast.covered() ? 1 : 0;
    for (const ForecastBand& band : forecast.by_speed) bands += band.covered() ? 1 : 0;
  }
  // 90 % of 300: 270 +- 5.2; the draws of theta are 60, whose percentiles scatter.
  EXPECT_THAT(covered, ::testing::AllOf(::testing::Ge(248), ::testing::Le(290)));
  EXPECT_THAT(bands, ::testing::AllOf(::testing::Ge(496), ::testing::Le(580)));
}

TEST(ForecastInterval, DoesNotCoverARigFarOutsideThePosterior) {
  int covered = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Forecast forecast = IntervalsOfToy(DrawToy(seed, kMean + 6.0 * kScatter, 2.0));
    covered += forecast.covered() ? 1 : 0;
  }
  EXPECT_EQ(covered, 0);
}

TEST(ForecastInterval, SaysWhetherCalibrationPays) {
  // A file that is 20 standard deviations off, and one that is as good as the mean and cannot lose.
  EXPECT_GT(IntervalsOfToy(DrawToy(3, kMean, kMean + 20.0 * kScatter)).better_than_file, 0.99);
  EXPECT_LT(IntervalsOfToy(DrawToy(3, kMean, kMean)).better_than_file, 0.01);
}

TEST(ForecastInterval, TakesADrawThatRunsAwayForInfinitelyFar) {
  Toy toy = DrawToy(5, kMean, 2.0);
  const double high_m = IntervalsOfToy(toy).residual_m.high;
  EXPECT_TRUE(std::isfinite(high_m));
  for (BandSums& band : toy.bands) {
    for (std::size_t j = 0; j < 10; ++j) band.apart_m2[j][0] = std::nan("");
  }
  const Forecast forecast = IntervalsOfToy(toy);
  EXPECT_EQ(forecast.residual_m.high, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isfinite(forecast.residual_m.low));
}

TEST(ForecastInterval, IsEmptyWithoutDrawsAndCoversNothing) {
  const Toy toy = DrawToy(7, kMean, 2.0, 0);
  const Forecast forecast = IntervalsOfToy(toy);
  EXPECT_TRUE(forecast.by_speed.empty());
  EXPECT_FALSE(forecast.covered());
}

}  // namespace
}  // namespace levitas::diagnosis
