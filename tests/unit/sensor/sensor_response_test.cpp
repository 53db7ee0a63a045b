// The sensor in time and frequency against the closed forms of a first-order filter and of an
// ideal converter.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "common/random.hpp"
#include "plant_sim/sensor/sensor.hpp"

namespace levitas::sensor {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

TEST(FilterStep, AnswersAStepWithTheExponential) {
  for (const double bandwidth_hz : {50.0, 5000.0, 200e3}) {
    const FilterStep filter = MakeFilterStep(bandwidth_hz, 1.0, 25e-6);
    double s = 0.0;
    for (int i = 1; i <= 40; ++i) {
      s = filter.decay * s + filter.start * 1.0 + filter.end * 1.0;
      const double expected = -std::expm1(-kTwoPi * bandwidth_hz * i * 25e-6);
      EXPECT_NEAR(s, expected, 1e-14) << bandwidth_hz << " Hz, step " << i;  // 40 roundings
    }
  }
}

TEST(FilterStep, HasTheGainAndPhaseOfTheFirstOrderAtEveryFrequency) {
  // g/(1 + j f/fb). The filter sees the polygon through the samples of the sine, whose fundamental
  // is (sin(a)/a)^2 of it, a = w h/2; the rest are harmonics of the sampling, filtered away too.
  constexpr double kStep_s = 5e-6;
  constexpr double kBandwidthHz = 5000.0;
  constexpr double kGain = 1.25;
  const FilterStep filter = MakeFilterStep(kBandwidthHz, kGain, kStep_s);
  for (const double frequency_hz : {10.0, 1000.0, 5000.0, 20000.0}) {
    const double w = kTwoPi * frequency_hz;
    const std::complex<double> turn = std::polar(1.0, w * kStep_s);
    // Steady state of s[n+1] = decay s[n] + start p[n] + end p[n+1] for p[n] = turn^n.
    const std::complex<double> found = (filter.start + filter.end * turn) / (turn - filter.decay);
    const std::complex<double> expected =
        kGain / std::complex<double>(1.0, frequency_hz / kBandwidthHz);
    // Polygon for sine: (w h)^2/12 = 3.3 % at 20 kHz, of which 1/4 reaches the output there.
    EXPECT_NEAR(std::abs(found - expected), 0.0,
                1.05 * std::pow(w * kStep_s, 2) / 12.0 * std::abs(expected) + 1e-12)
        << frequency_hz;
  }
}

TEST(FilterStep, GivesTheSameWhetherAStraightPieceIsTakenInOneStepOrInMany) {
  Random random(21);
  for (int draw = 0; draw < 2000; ++draw) {
    const double bandwidth_hz = std::pow(10.0, 1.0 + 4.0 * random.Uniform());
    const double duration_s = std::pow(10.0, -7.0 + 4.0 * random.Uniform());
    const double gain = 0.5 + random.Uniform();
    const auto pieces = static_cast<int>(2 + random.Bits() % 30);
    const double from = random.Normal();
    const double to = random.Normal();
    const double start = random.Normal();
    const FilterStep whole = MakeFilterStep(bandwidth_hz, gain, duration_s);
    const FilterStep part = MakeFilterStep(bandwidth_hz, gain, duration_s / pieces);
    double many = start;
    for (int i = 0; i < pieces; ++i) {
      const double a = from + (to - from) * i / pieces;
      const double b = from + (to - from) * (i + 1) / pieces;
      many = part.decay * many + part.start * a + part.end * b;
    }
    const double one = whole.decay * start + whole.start * from + whole.end * to;
    // Thirty roundings; near the series' limit, ratio 1e-4, the difference loses up to 1e-12.
    EXPECT_NEAR(many, one, 1e-11) << bandwidth_hz << " Hz, " << duration_s << " s";
  }
}

TEST(FilterStep, StaysBetweenItsPastAndItsInputHoweverLongTheStep) {
  // A filter of first order cannot overshoot: all weights positive, together one.
  for (double ratio = 1e-9; ratio < 1e6; ratio *= 1.7) {
    const FilterStep filter = MakeFilterStep(ratio / kTwoPi, 1.0, 1.0);
    EXPECT_GE(filter.decay, 0.0) << ratio;
    EXPECT_GE(filter.start, 0.0) << ratio;
    EXPECT_GE(filter.end, 0.0) << ratio;
    EXPECT_NEAR(filter.decay + filter.start + filter.end, 1.0, 1e-15) << ratio;  // rounding
  }
  // Fast against the step: it reads the end of it. Slow against it: it has not moved.
  EXPECT_NEAR(MakeFilterStep(1e6, 1.0, 1.0).end, 1.0, 1e-6);
  EXPECT_NEAR(MakeFilterStep(1e-9, 1.0, 1.0).decay, 1.0, 1e-8);
}

TEST(Convert, QuantisesWithTheVarianceOfAUniformError) {
  // Bennett (1948): step^2/12 and no bias, for a signal that crosses many steps.
  Random random(22);
  const Converter converter{0.0, 1e-6, 400e-6};
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    const double value_m = 300e-6 * (2.0 * random.Uniform() - 1.0);
    const double error = (Convert(converter, value_m, 0.0) - value_m) / 1e-6;
    ASSERT_LE(std::abs(error), 0.5 + 1e-9);  // rounding of 300 steps
    sum += error;
    squares += error * error;
  }
  // Five standard errors: sqrt(1/12/n) = 9e-4, and sqrt(1/180/n) = 2.4e-4.
  EXPECT_NEAR(sum / kCount, 0.0, 4.6e-3);
  EXPECT_NEAR(squares / kCount, 1.0 / 12.0, 1.2e-3);
}

TEST(Convert, AddsTheVariancesOfNoiseAndConverter) {
  Random random(23);
  const Converter converter{1.5e-6, 1e-6, 400e-6};
  double squares = 0.0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    const double value_m = 100e-6 * (2.0 * random.Uniform() - 1.0);
    const double error = (Convert(converter, value_m, random.Normal()) - value_m) / 1e-6;
    squares += error * error;
  }
  // Variance of a variance: about 2/n of it, five standard errors are 2.2 %.
  EXPECT_NEAR(squares / kCount / (2.25 + 1.0 / 12.0), 1.0, 0.023);
}

TEST(Convert, IsAMonotoneOddStaircaseThatKeepsItsOwnValues) {
  Random random(24);
  const Converter converter{0.0, 0.4e-6, 100e-6};
  double before_m = -1.0;
  for (double value_m = -120e-6; value_m < 120e-6; value_m += 3.7e-8) {
    const double read_m = Convert(converter, value_m, 0.0);
    EXPECT_GE(read_m, before_m) << value_m;
    EXPECT_EQ(Convert(converter, -value_m, 0.0), -read_m) << value_m;
    EXPECT_DOUBLE_EQ(Convert(converter, read_m, 0.0), read_m) << value_m;  // 250 steps of 0.4 um
    EXPECT_LE(std::abs(read_m), 100e-6) << value_m;
    before_m = read_m;
  }
}

TEST(Convert, ClipsNoiseTooSoThatNoReadingLeavesTheRange) {
  Random random(25);
  const Converter converter{50e-6, 1e-6, 100e-6};
  int clipped = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double read_m = Convert(converter, 60e-6, random.Normal());
    ASSERT_LE(std::abs(read_m), 100e-6);
    if (read_m == 100e-6) ++clipped;
  }
  // Above 99.5 um, which rounds to the range: P(z > 0.79) = 0.2148; five standard errors are 1.5 %.
  EXPECT_NEAR(clipped / 20'000.0, 0.2148, 0.015);
}

TEST(Convert, ShowsWhatIsNotANumberAndClipsWhatIsEndless) {
  const Converter converter{0.0, 1e-6, 400e-6};
  EXPECT_TRUE(std::isnan(Convert(converter, std::nan(""), 0.0)));
  EXPECT_EQ(Convert(converter, INFINITY, 0.0), 400e-6);
  EXPECT_EQ(Convert(converter, -INFINITY, 0.0), -400e-6);
}

}  // namespace
}  // namespace levitas::sensor
