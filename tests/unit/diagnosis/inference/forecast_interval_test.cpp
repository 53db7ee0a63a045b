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

constexpr std::size_t kBandRows = 1000;
constexpr std::size_t kNoiseRows = 100;
constexpr double kBelieved = 1.0;
constexpr double kBelievedTo = 0.3;

struct ForecastToy {
  std::vector<BandSums> bands;
  std::vector<NoiseBlock> noise;
};

double SquareOfNumber(double value) { return value * value; }

/// Two bands of speed; the second has three times the motion. The file says `file`.
ForecastToy DrawForecast(std::uint64_t seed, double truth, double file, int draws = 60) {
  Random random(seed);
  ForecastToy toy;
  for (int block = 0; block < 60; ++block) {
    double sum = 0.0;
    for (std::size_t n = 0; n < kNoiseRows; ++n) sum += SquareOfNumber(random.Normal());
    toy.noise.push_back({0, {sum / static_cast<double>(kNoiseRows)}});
  }
  std::vector<double> thetas;
  for (int j = 0; j < draws; ++j) thetas.push_back(kBelieved + kBelievedTo * random.Normal());
  for (const double size : {1.0, 3.0}) {
    BandSums band{100.0 * size, 200.0 * size, kBandRows, {0.0}, {0.0}, {}, {}};
    double power = 0.0;
    for (std::size_t n = 0; n < kBandRows; ++n) {
      const double x = size * random.Normal();
      const double y = truth * x + random.Normal();
      power += x * x;
      band.motion_m2[0] += y * y;
      band.left_m2[0] += SquareOfNumber(y - kBelieved * x);
    }
    for (const double theta : thetas) {
      band.apart_m2.push_back({SquareOfNumber(theta - kBelieved) * power});
      band.apart_from_file_m2.push_back({SquareOfNumber(theta - file) * power});
    }
    toy.bands.push_back(band);
  }
  return toy;
}

Forecast IntervalsOfToy(const ForecastToy& toy) {
  return IntervalsOf(toy.bands, toy.noise, kNoiseRows, 0.0);
}

TEST(ForecastInterval, CoversATruthOfThePosteriorAsOftenAsItSays) {
  constexpr int kTrials = 300;
  Random random(41);
  int covered = 0;
  int bands = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double truth = kBelieved + kBelievedTo * random.Normal();
    const Forecast forecast =
        IntervalsOfToy(DrawForecast(1000 + static_cast<std::uint64_t>(trial), truth, 2.0));
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
    const Forecast forecast =
        IntervalsOfToy(DrawForecast(seed, kBelieved + 6.0 * kBelievedTo, 2.0));
    covered += forecast.covered() ? 1 : 0;
  }
  EXPECT_EQ(covered, 0);
}

TEST(ForecastInterval, SaysWhetherCalibrationPays) {
  // A file that is 20 standard deviations off, and one that is as good as the mean and cannot lose.
  EXPECT_GT(
      IntervalsOfToy(DrawForecast(3, kBelieved, kBelieved + 20.0 * kBelievedTo)).better_than_file,
      0.99);
  EXPECT_LT(IntervalsOfToy(DrawForecast(3, kBelieved, kBelieved)).better_than_file, 0.01);
}

TEST(ForecastInterval, TakesADrawThatRunsAwayForInfinitelyFar) {
  ForecastToy toy = DrawForecast(5, kBelieved, 2.0);
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
  const ForecastToy toy = DrawForecast(7, kBelieved, 2.0, 0);
  const Forecast forecast = IntervalsOfToy(toy);
  EXPECT_TRUE(forecast.by_speed.empty());
  EXPECT_FALSE(forecast.covered());
}

}  // namespace
}  // namespace levitas::diagnosis
