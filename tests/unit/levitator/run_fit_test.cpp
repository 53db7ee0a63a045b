// Fits, ceilings and shares against values worked out by hand.

#include "diagnosis/levitator/run_fit.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

std::vector<double> White(double deviation, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> values(count);
  for (double& value : values) value = deviation * random.Normal();
  return values;
}

TEST(WhiteNoise, IsTheDeviationOfWhiteNoiseAndBlindToASlowSwing) {
  std::vector<double> values = White(2.0, 20'000, 1);
  // Fourth differences of 20 000 values: some 1 % of scatter.
  EXPECT_NEAR(WhiteNoise(values), 2.0, 0.06);
  for (std::size_t n = 0; n < values.size(); ++n) {
    values[n] += 50.0 * std::sin(0.02 * static_cast<double>(n));
  }
  EXPECT_NEAR(WhiteNoise(values), 2.0, 0.06);
  EXPECT_EQ(WhiteNoise({1.0, 2.0}), 0.0);
}

TEST(Ceiling, IsTheFitThatNoiseLeaves) {
  const std::vector<double> square{1.0, -1.0, 1.0, -1.0};
  EXPECT_NEAR(Ceiling(square, 0.25), 75.0, 1e-12);
  EXPECT_NEAR(Ceiling(square, 0.0), 100.0, 1e-12);
}

TEST(SharePercent, IsWhatWasTakenOfWhatCouldBeTaken) {
  const std::vector<double> before(2000, 2.0);
  const std::vector<double> after(2000, 1.5);
  // (4 - 2.25)/(4 - 1)
  const Fit share = SharePercent(before, after, 1.0, 1e-3);
  EXPECT_NEAR(share.percent, 100.0 * 1.75 / 3.0, 1e-9);
  EXPECT_NEAR(share.low, share.high, 1e-9);  // every block says the same
}

TEST(SharePercent, HasAnIntervalAroundItsValueWhereBlocksDiffer) {
  const std::vector<double> before = White(2.0, 10'000, 2);
  const std::vector<double> after = White(1.2, 10'000, 3);
  const Fit share = SharePercent(before, after, 1.0, 1e-3);
  EXPECT_LT(share.low, share.percent);
  EXPECT_GT(share.high, share.percent);
}

TEST(RunFit, IsPerfectForAModelOfItsOwnDataAndWorseForAnother) {
  const NominalRig rig = NominalOf(test::LevitatorFile());
  Theta truth = Zeros(1);
  truth[kProfile] = 0.8;
  const Series series = test::LivelySeries(rig, truth, 3000, 4);
  const Errors own = ErrorsOf(rig, series, truth, 0);
  const RunFit fit = FitOf(own, rig.period_s);
  const double ceiling = Ceiling(own.measured_a[0], WhiteNoise(own.current_a[0]));
  EXPECT_NEAR(fit.current.percent, ceiling, 0.3);  // 3000 values of noise: 1.3 % of 2 %
  EXPECT_LT(fit.current.low, fit.current.percent);
  const RunFit nominal = FitOf(ErrorsOf(rig, series, Zeros(1), 0), rig.period_s);
  EXPECT_LT(nominal.current.percent, fit.current.percent - 10.0);
}

}  // namespace
}  // namespace levitas::levitator
