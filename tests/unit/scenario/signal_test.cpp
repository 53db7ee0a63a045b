// Each kind of test signal against the closed form that defines it.

#include "controller/scenario/signal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/support/allocation_guard.hpp"

namespace levitas::scenario {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kSignalPeriod_s = 50e-6;  // 20 kHz

Excitation Of(SignalKind kind) {
  Excitation e;
  e.kind = kind;
  e.order = 15;
  e.divisor = 1;
  return e;
}

std::vector<double> Values(Signal& signal, std::size_t count) {
  std::vector<double> values(count);
  for (double& value : values) value = signal.Next();
  return values;
}

/// Amplitude of one frequency, `cycles` a whole number of its periods.
double Line(const std::vector<double>& values, double frequency_hz) {
  std::complex<double> sum = 0.0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    sum += values[n] *
           std::polar(1.0, -kTwoPi * frequency_hz * static_cast<double>(n) * kSignalPeriod_s);
  }
  return 2.0 * std::abs(sum) / static_cast<double>(values.size());
}

TEST(Paprbs, HasTheSignsOfThePrbsAndAmplitudesSpreadEvenlyBetweenItsBounds) {
  Excitation e = Of(SignalKind::kPaprbs);
  e.low_share = 0.2;
  e.divisor = 10;  // 0.5 ms a bit, as the paper has it
  Signal signal(e, kSignalPeriod_s);
  Prbs signs(15);
  constexpr int kBits = 8000;
  double sum = 0.0;
  double square = 0.0;
  for (int bit = 0; bit < kBits; ++bit) {
    const double value = signal.Next();
    for (int cycle = 1; cycle < 10; ++cycle) ASSERT_EQ(signal.Next(), value);
    ASSERT_EQ(value > 0.0, signs.Next());
    ASSERT_GE(std::abs(value), 0.2);
    ASSERT_LT(std::abs(value), 1.0);
    sum += std::abs(value);
    square += value * value;
  }
  // Uniform between a and b: mean (a+b)/2 = 0.6, mean square (a^2+ab+b^2)/3 = 0.41333; standard
  // errors of 8000 draws 0.0026 and 0.0033, five of them.
  EXPECT_NEAR(sum / kBits, 0.6, 0.013);
  EXPECT_NEAR(square / kBits, 0.41333, 0.017);
}

// Four inputs, one sequence begun at each quarter, 8000 bits: no pair may be correlated at any lag
// up to 200 bits. For independent bits the coefficient scatters by 1/sqrt(8000) = 0.011; of the 6 x
// 401 values the largest stays below 4.5 of that.
TEST(Paprbs, QuarterStartsAreUncorrelated) {
  std::array<std::vector<double>, 4> inputs;
  for (std::size_t i = 0; i < 4; ++i) {
    Excitation e = Of(SignalKind::kPaprbs);
    e.start = 0.25 * static_cast<double>(i);
    e.seed = i + 1;
    Signal signal(e, kSignalPeriod_s);
    inputs[i] = Values(signal, 8000);
  }
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) {
      for (int lag = -200; lag <= 200; ++lag) {
        double sum = 0.0;
        double energy = 0.0;
        for (int n = 200; n < 7800; ++n) {
          const double x = inputs[a][static_cast<std::size_t>(n)];
          sum += x * inputs[b][static_cast<std::size_t>(n + lag)];
          energy += x * x;
        }
        ASSERT_LT(std::abs(sum / energy), 0.05) << a << b << " lag " << lag;
      }
    }
  }
}

// The other half of the pair: begun at the same place, two inputs are one.
TEST(Paprbs, EqualStartsAndSeedsAreTheSameSignal) {
  Signal one(Of(SignalKind::kPaprbs), kSignalPeriod_s);
  Signal other(Of(SignalKind::kPaprbs), kSignalPeriod_s);
  EXPECT_EQ(Values(one, 1000), Values(other, 1000));
}

TEST(SteppedSine, DwellsOnEachFrequencyWithoutABreakOfPhase) {
  Excitation e = Of(SignalKind::kSteppedSine);
  e.from_hz = 100.0;
  e.to_hz = 400.0;
  e.frequencies = 3;  // by equal ratios: 100, 200, 400
  e.dwell_s = 0.1;
  Signal signal(e, kSignalPeriod_s);
  double last = 0.0;
  for (const double frequency_hz : {100.0, 200.0, 400.0, 100.0}) {
    const std::vector<double> values = Values(signal, 2000);
    EXPECT_NEAR(Line(values, frequency_hz), 1.0, 1e-9);  // whole periods: rounding only
    EXPECT_LT(std::abs(values.front() - last), kTwoPi * 400.0 * kSignalPeriod_s);  // largest slope
    last = values.back();
  }
}

TEST(SteppedSine, SpacesFrequenciesEvenlyWhenAskedTo) {
  Excitation e = Of(SignalKind::kSteppedSine);
  e.from_hz = 100.0;
  e.to_hz = 300.0;
  e.frequencies = 3;
  e.dwell_s = 0.1;
  e.linear = true;
  Signal signal(e, kSignalPeriod_s);
  for (const double frequency_hz : {100.0, 200.0, 300.0}) {
    EXPECT_NEAR(Line(Values(signal, 2000), frequency_hz), 1.0, 1e-9);
  }
}

// Phase of an exponential sweep: f0 D/ln(r) (r^(t/D) - 1) turns; of a linear one f0 t + (f1-f0)
// t^2/2D.
TEST(Chirp, HasThePhaseOfItsSweep) {
  for (const bool linear : {false, true}) {
    Excitation e = Of(SignalKind::kChirp);
    e.from_hz = 10.0;
    e.to_hz = 1000.0;
    e.repeat_s = 1.0;
    e.linear = linear;
    Signal signal(e, kSignalPeriod_s);
    for (int n = 0; n < 20'000; ++n) {
      const double t = n * kSignalPeriod_s;
      const double turns = linear ? 10.0 * t + 990.0 * t * t / 2.0
                                  : 10.0 / std::log(100.0) * (std::pow(100.0, t) - 1.0);
      // The sum over midpoints differs from the integral by f'' T^2/24 a second: 4e-5 turns.
      ASSERT_NEAR(signal.Next(), std::sin(kTwoPi * turns), kTwoPi * 5e-5) << n;
    }
  }
}

TEST(Chirp, RepeatsItselfWhereASweepIsNoWholeNumberOfTurns) {
  Excitation e = Of(SignalKind::kChirp);
  e.from_hz = 3.0;
  e.to_hz = 700.0;
  e.repeat_s = 0.1;  // 12.8 turns
  Signal signal(e, kSignalPeriod_s);
  const std::vector<double> first = Values(signal, 2000);
  for (int again = 0; again < 3; ++again) EXPECT_EQ(Values(signal, 2000), first) << again;
}

TEST(Multisine, HoldsEqualLinesWithinItsBandAndNoneOutside) {
  Excitation e = Of(SignalKind::kMultisine);
  e.from_hz = 20.0;
  e.to_hz = 500.0;
  e.repeat_s = 0.1;  // lines every 10 Hz: 49 of them
  Signal signal(e, kSignalPeriod_s);
  const std::vector<double> values = Values(signal, 2000);
  const double amplitude = Line(values, 20.0);
  double peak = 0.0;
  for (const double value : values) peak = std::max(peak, std::abs(value));
  EXPECT_NEAR(peak, 1.0, 1e-12);
  for (double f = 10.0; f <= 600.0; f += 10.0) {
    EXPECT_NEAR(Line(values, f), f >= 20.0 && f <= 500.0 ? amplitude : 0.0, 1e-9) << f;
  }
  // Crest factor: peak over rms. All cosines in phase would have sqrt(2 x 49) = 9.9; Schroeder's
  // phases stay below 2 (his paper gives about 1.7 for many lines).
  EXPECT_LT(1.0 / (amplitude * std::sqrt(49.0 / 2.0)), 2.0);
  EXPECT_EQ(Values(signal, 2000), values);  // and again
}

TEST(Impulse, LastsItsWidthAndComesAgainOnlyWhenAskedTo) {
  Excitation e = Of(SignalKind::kImpulse);
  e.width_s = 1e-3;
  Signal once(e, kSignalPeriod_s);
  e.repeat_s = 0.1;
  Signal again(e, kSignalPeriod_s);
  for (int n = 0; n < 6000; ++n) {
    EXPECT_EQ(once.Next(), n < 20 ? 1.0 : 0.0);
    EXPECT_EQ(again.Next(), n % 2000 < 20 ? 1.0 : 0.0);
  }
}

TEST(Signal, StaysWithinItsAmplitudeAndAllocatesNothing) {
  for (const SignalKind kind : {SignalKind::kPrbs, SignalKind::kPaprbs, SignalKind::kSteppedSine,
                                SignalKind::kChirp, SignalKind::kMultisine, SignalKind::kImpulse}) {
    Excitation e = Of(kind);
    e.from_hz = 5.0;
    e.to_hz = 2000.0;
    e.frequencies = 40;
    e.dwell_s = 0.01;
    e.repeat_s = 0.2;
    e.width_s = 0.001;
    Signal signal(e, kSignalPeriod_s);
    double largest = 0.0;
    const test::AllocationGuard guard;
    for (int n = 0; n < 20'000; ++n) largest = std::max(largest, std::abs(signal.Next()));
    EXPECT_EQ(guard.count(), 0U);
    EXPECT_LE(largest, 1.0 + 1e-12);
    EXPECT_GT(largest, 0.9);
  }
}

}  // namespace
}  // namespace levitas::scenario
