// What causes gain, against the scatter of it from block to block.

#include "diagnosis/inference/fit_gain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kBlockRows = 500;
constexpr std::size_t kFortyBlocks = 20'000;  // forty blocks
constexpr double kResidual = 0.3;             // of the noise

/// Noise of one seed with a residual on it where `there` says so.
template <class There>
std::vector<Trajectory> WithResidual(There there) {
  return {NoiseRun(3, kFortyBlocks, [there](std::size_t n, SamplePoint& m) {
    if (!there(n)) return;
    for (float& value : m.innovation_m) value += static_cast<float>(kResidual * kNoise);
  })};
}

std::vector<Trajectory> Clean() {
  return WithResidual([](std::size_t) { return false; });
}

double Deviations(const std::vector<Trajectory>& before) {
  const auto after = Clean();
  const FitGain gain = GainedFit(before, after, MakeWhitener(after, TheRig().axes, 0), kBlockRows);
  return gain.value / gain.deviation;
}

TEST(FitGain, OfAResidualThatIsEverywhereIsBeyondItsScatter) {
  const auto before = WithResidual([](std::size_t) { return true; });
  const auto after = Clean();
  const FitGain gain = GainedFit(before, after, MakeWhitener(after, TheRig().axes, 0), kBlockRows);
  // Four axes; 2 e d has a variance of 4 d^2 per sample.
  const double samples = 4.0 * static_cast<double>(kFortyBlocks);
  EXPECT_NEAR(gain.value, kResidual * kResidual * samples,
              4.0 * 2.0 * kResidual * std::sqrt(samples));
  EXPECT_NEAR(gain.deviation, 2.0 * kResidual * std::sqrt(samples), 0.3 * gain.deviation);
  EXPECT_GT(gain.value, 5.0 * gain.deviation);
}

TEST(FitGain, OfOneStretchAloneIsWithinItsScatter) {
  const double everywhere = Deviations(WithResidual([](std::size_t) { return true; }));
  const double once = Deviations(WithResidual([](std::size_t n) { return n / kBlockRows == 7; }));
  EXPECT_LT(once, Judging{}.gain_deviations);
  EXPECT_GT(everywhere, Judging{}.gain_deviations);
}

TEST(FitGain, OfModelsThatAreTheSameIsNothing) {
  const auto runs = Clean();
  const FitGain gain = GainedFit(runs, runs, MakeWhitener(runs, TheRig().axes, 0), kBlockRows);
  EXPECT_EQ(gain.value, 0.0);
  EXPECT_EQ(gain.deviation, 0.0);
}

Term Nuisance(double tolerance) {
  Term term;
  term.effect = effect::Id::kCurrentGain;
  term.tolerance = tolerance;
  return term;
}

TEST(FitGain, CountsWhatACauseTakesFromTheCalibration) {
  const std::vector<Term> terms{Nuisance(0.03), Nuisance(0.1)};
  Hypothesis first;
  first.terms = {0};
  // The first is the cause's; the second comes back from two tolerances to one.
  EXPECT_NEAR(CameBack(terms, {-0.12, 0.2}, {-0.12, 0.1}, {first}), 16.0 + 3.0, 1e-9);
  EXPECT_NEAR(CameBack(terms, {-0.12, 0.2}, {-0.12, 0.2}, {}), 0.0, 1e-9);
}

}  // namespace
}  // namespace levitas::diagnosis
