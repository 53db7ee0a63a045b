#include "controller/synchronous/generalised_notch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <stdexcept>

#include "common/random.hpp"
#include "controller/synchronous/influence_estimate.hpp"
#include "tests/unit/synchronous/bench_numbers.hpp"

namespace levitas::synchronous {
namespace {

using Complex = std::complex<double>;

constexpr double kHz = 50.0;

BlockConfig Block(std::size_t axes) {
  BlockConfig block;
  block.from_rad_per_s = 100.0;
  block.to_rad_per_s = 500.0;
  InverseAtSpeed at;
  at.speed_rad_per_s = 300.0;
  for (std::size_t i = 0; i < axes; ++i) at.inverse.real[i][i] = 1.0;
  block.inverse.push_back(at);
  return block;
}

TEST(InverseLadder, IsTheTableAtItsSpeedsAndTheStraightLineBetween) {
  BlockConfig block = Block(2);
  InverseAtSpeed higher = block.inverse.front();
  higher.speed_rad_per_s = 400.0;
  higher.inverse.real[0][0] = 3.0;
  higher.inverse.imaginary[1][0] = -2.0;
  block.inverse.push_back(higher);
  const ComplexMatrix quarter = InverseAt(block, 325.0);
  EXPECT_DOUBLE_EQ(quarter.real[0][0], 1.5);
  EXPECT_DOUBLE_EQ(quarter.imaginary[1][0], -0.5);
  EXPECT_DOUBLE_EQ(InverseAt(block, 10.0).real[0][0], 1.0);
  EXPECT_DOUBLE_EQ(InverseAt(block, 1e4).real[0][0], 3.0);
  const InverseLadder ladder(block);
  const double width = 400.0 / static_cast<double>(InverseLadder::kRungs - 1);
  EXPECT_NEAR(ladder.At(325.0).real[0][0], 1.5, 0.02 * width);
  EXPECT_NEAR(ladder.At(325.0).imaginary[0][1], -0.5, 0.02 * width) << "[from][to]";
  EXPECT_EQ(&ladder.At(-1e9), &ladder.At(0.0));
  EXPECT_DOUBLE_EQ(ladder.At(1e9).real[0][0], 3.0);
}

TEST(InverseLadder, RefusesWindowsAndTablesThatCannotBe) {
  BlockConfig block = Block(2);
  block.to_rad_per_s = 50.0;
  EXPECT_THROW(InverseLadder{block}, std::invalid_argument);
  block = Block(2);
  block.inverse.push_back(block.inverse.front());
  EXPECT_THROW(InverseLadder{block}, std::invalid_argument);
  block.inverse.clear();
  EXPECT_THROW(InverseLadder{block}, std::invalid_argument);
}

/// Something that answers at once: e = -M (d + c), real parts as signals.
struct Still {
  Complex answer[2][2]{};
  Complex disturbance[2]{};

  AxisArray Error(const NotchState& state, const UnitPhasor& p) const {
    AxisArray error{};
    const Complex phasor(p.cosine, p.sine);
    for (std::size_t i = 0; i < 2; ++i) {
      Complex sum;
      for (std::size_t j = 0; j < 2; ++j) {
        sum -= answer[i][j] * (disturbance[j] + Complex(state.real[j], state.imaginary[j]));
      }
      error[i] = (sum * phasor).real();
    }
    return error;
  }
};

Still Drawn(std::uint64_t seed) {
  Random draw(seed);
  Still still;
  for (auto& row : still.answer) {
    for (Complex& element : row) element = {draw.Normal(), draw.Normal()};
  }
  still.answer[0][0] += 3.0;
  still.answer[1][1] += 3.0;
  for (Complex& d : still.disturbance) d = 1e-5 * Complex(draw.Normal(), draw.Normal());
  return still;
}

InverseLanes InverseOf(const Still& still) {
  const auto& m = still.answer;
  const Complex det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  const Complex inverse[2][2] = {{m[1][1] / det, -m[0][1] / det}, {-m[1][0] / det, m[0][0] / det}};
  InverseLanes lanes;
  for (std::size_t to = 0; to < 2; ++to) {
    for (std::size_t from = 0; from < 2; ++from) {
      lanes.real[from][to] = inverse[to][from].real();
      lanes.imaginary[from][to] = inverse[to][from].imag();
    }
  }
  return lanes;
}

double Left(const Still& still, const NotchState& state) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    sum += std::norm(still.disturbance[i] + Complex(state.real[i], state.imaginary[i]));
  }
  return std::sqrt(sum);
}

TEST(GeneralisedNotch, WithTheInverseWhatIsLeftDecaysWithItsTimeConstant) {
  constexpr double kTimeConstantS = 0.3;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Still still = Drawn(seed);
    const InverseLanes inverse = InverseOf(still);
    NotchState state;
    const double before = Left(still, state);
    for (int n = 0; n < 6000; ++n) {
      const UnitPhasor phasor = PhasorOfTurns(kHz * kPeriodS * n);
      Adapt(inverse, phasor, 2.0 * kPeriodS / kTimeConstantS, 2, still.Error(state, phasor), state);
    }
    // The ripple at twice the frequency is of the order 1/(2 w tau) = 0.5 %.
    EXPECT_NEAR(Left(still, state) / before, std::exp(-0.6 / kTimeConstantS), 0.01) << seed;
  }
}

TEST(GeneralisedNotch, WithTheOppositeSignItGrows) {
  const Still still = Drawn(3);
  InverseLanes inverse = InverseOf(still);
  for (auto& row : inverse.real) {
    for (double& value : row) value = -value;
  }
  for (auto& row : inverse.imaginary) {
    for (double& value : row) value = -value;
  }
  NotchState state;
  const double before = Left(still, state);
  for (int n = 0; n < 6000; ++n) {
    const UnitPhasor phasor = PhasorOfTurns(kHz * kPeriodS * n);
    Adapt(inverse, phasor, 2.0 * kPeriodS / 0.3, 2, still.Error(state, phasor), state);
  }
  EXPECT_GT(Left(still, state), 5.0 * before);
}

TEST(GeneralisedNotch, AddsTheRealPartOfItsTurningAmplitude) {
  NotchState state;
  state.real[0] = 2.0;
  state.imaginary[1] = 3.0;
  AxisArray signal{};
  AddTurning(state.real, state.imaginary, PhasorOfTurns(0.25), 1.0, signal);
  EXPECT_DOUBLE_EQ(signal[0], 0.0);
  EXPECT_DOUBLE_EQ(signal[1], -3.0) << "Re(3j e^{j 90 deg})";
  EXPECT_DOUBLE_EQ(LargestAmplitude(state), 3.0);
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    NotchState broken = state;
    broken.imaginary[i] = std::nan("");
    EXPECT_TRUE(std::isnan(LargestAmplitude(broken))) << i << ": a limit would not see it";
  }
}

TEST(InfluenceEstimate, LearnsWhatTheModelHasWrongAndLeavesARightOneAlone) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Still still = Drawn(seed);
    // The model's answer: another one altogether, of which the right T is a correction.
    const InverseLanes wrong = InverseOf(Drawn(seed + 100));
    for (const bool right : {true, false}) {
      const InverseLanes inverse = right ? InverseOf(still) : wrong;
      InfluenceEstimate estimate(2, kPeriodS, 1e-8);
      NotchState state;
      const double before = Left(still, state);
      for (int n = 0; n < 60'000; ++n) {
        const UnitPhasor phasor = PhasorOfTurns(kHz * kPeriodS * n);
        const AxisArray error = still.Error(state, phasor);
        estimate.Observe(inverse, phasor, kHz * kPeriodS, error, state);
        Adapt(estimate.Corrected(inverse), phasor, 2.0 * kPeriodS / 0.5, 2, error, state);
      }
      EXPECT_LT(Left(still, state), 0.02 * before) << seed << (right ? " right" : " wrong");
      if (!right) continue;
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(std::abs(estimate.element(i, i) - 1.0), 0.0, 0.05);
        EXPECT_NEAR(std::abs(estimate.element(i, 1 - i)), 0.0, 0.05);
      }
    }
  }
}

TEST(InfluenceEstimate, NoiseWithoutExcitationTeachesNothing) {
  InfluenceEstimate estimate(2, kPeriodS, 0.5e-6);
  const InverseLanes inverse = InverseOf(Drawn(1));
  Random draw(7);
  const NotchState state;
  for (int n = 0; n < 100'000; ++n) {
    AxisArray error{};
    for (std::size_t i = 0; i < 2; ++i) error[i] = 1e-6 * draw.Normal();
    estimate.Observe(inverse, PhasorOfTurns(kHz * kPeriodS * n), kHz * kPeriodS, error, state);
  }
  EXPECT_EQ(estimate.learned(), 0U);
}

}  // namespace
}  // namespace levitas::synchronous
