// The state-space law against closed forms, and against the equations written out in full.

#include "controller/law/state_space_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/random.hpp"
#include "controller/law/axis_law.hpp"
#include "tests/support/allocation_guard.hpp"

namespace levitas::law {
namespace {

constexpr double kPeriod_s = 50e-6;
constexpr double kNoLimit_a = 1e9;

StateSpaceConfig OneAxis(const ModalBlock& block, double direct = 0.0) {
  StateSpaceConfig law;
  law.axes = 1;
  law.blocks = {block};
  law.direct[0][0] = direct;
  law.input_v_per_m = {1.0};
  law.output_a_per_v = {1.0};
  return law;
}

ModalBlock Block(double re, double im, double b1, double b2, double c1, double c2) {
  ModalBlock block;
  block.pole_real = re;
  block.pole_imaginary = im;
  block.first_input = {b1};
  block.second_input = {b2};
  block.first_output = {c1};
  block.second_output = {c2};
  return block;
}

/// Law with every axis coupled to every block, drawn from a written seed.
StateSpaceConfig RandomLaw(std::size_t axes, std::size_t pairs, std::size_t singles, Random& draw) {
  const auto coefficient = [&] { return 2.0 * draw.Uniform() - 1.0; };
  StateSpaceConfig law;
  law.axes = axes;
  law.discrete = true;
  for (std::size_t k = 0; k < pairs + singles; ++k) {
    ModalBlock block;
    const double modulus = 0.3 + 0.65 * draw.Uniform();
    const double angle = 3.0 * draw.Uniform();
    block.pole_real = modulus * std::cos(angle);
    block.pole_imaginary = k < pairs ? modulus * std::sin(angle) : 0.0;
    for (std::size_t i = 0; i < axes; ++i) {
      block.first_input[i] = coefficient();
      block.first_output[i] = coefficient();
      block.second_input[i] = k < pairs ? coefficient() : 0.0;
      block.second_output[i] = k < pairs ? coefficient() : 0.0;
    }
    law.blocks.push_back(block);
  }
  for (std::size_t i = 0; i < axes; ++i) {
    law.input_v_per_m[i] = 0.5 + draw.Uniform();
    law.output_a_per_v[i] = 0.5 + draw.Uniform();
    for (std::size_t j = 0; j < axes; ++j) law.direct[i][j] = coefficient();
  }
  return law;
}

/// The same equations, one state at a time, as a textbook writes them.
struct Textbook {
  explicit Textbook(StateSpaceConfig config) : law(std::move(config)), w(2 * law.blocks.size()) {}

  AxisArray Step(const AxisArray& error_m, const AxisArray& excitation_a, double limit_a) {
    AxisArray v{};
    for (std::size_t j = 0; j < law.axes; ++j) v[j] = -law.input_v_per_m[j] * error_m[j];
    AxisArray current_a{};
    for (std::size_t i = 0; i < law.axes; ++i) {
      double sum = 0.0;
      for (std::size_t k = 0; k < law.blocks.size(); ++k) {
        sum += law.blocks[k].first_output[i] * w[2 * k] +
               law.blocks[k].second_output[i] * w[2 * k + 1];
      }
      for (std::size_t j = 0; j < law.axes; ++j) sum += law.direct[i][j] * v[j];
      current_a[i] = std::clamp(law.output_a_per_v[i] * sum + excitation_a[i], -limit_a, limit_a);
    }
    for (std::size_t k = 0; k < law.blocks.size(); ++k) {
      const ModalBlock& b = law.blocks[k];
      double first = b.pole_real * w[2 * k] + b.pole_imaginary * w[2 * k + 1];
      double second = b.pole_real * w[2 * k + 1] - b.pole_imaginary * w[2 * k];
      for (std::size_t j = 0; j < law.axes; ++j) {
        first += b.first_input[j] * v[j];
        second += b.second_input[j] * v[j];
      }
      w[2 * k] = first;
      w[2 * k + 1] = second;
    }
    return current_a;
  }

  StateSpaceConfig law;
  std::vector<double> w;
};

// w' = -s w + b v under a constant v: w(t) = (b/s)(1 - e^{-s t}), which a hold samples exactly.
TEST(StateSpaceLaw, FollowsAStepAsTheContinuousRealPoleDoes) {
  const double decay = 700.0;
  const StateSpaceCoefficients law(OneAxis(Block(-decay, 0.0, 3.0, 0.0, 2.0, 0.0)), kPeriod_s);
  StateSpaceState state(law.blocks());
  for (int n = 0; n < 400; ++n) {
    const LawOutput out = Step(law, state, {-1.0}, {}, kNoLimit_a);
    const double exact = 2.0 * 3.0 / decay * (1.0 - std::exp(-decay * n * kPeriod_s));
    // 400 roundings of a number below 0.01.
    ASSERT_NEAR(out.control_current_a[0], exact, 1e-15 * 400) << n;
  }
}

// Impulse of the pair: B enters through the hold, then w turns and decays as e^{At} does.
TEST(StateSpaceLaw, FollowsAStepAsTheContinuousPairDoes) {
  const double s = 600.0;
  const double w = 3300.0;
  const StateSpaceCoefficients law(OneAxis(Block(-s, w, 1.0, 0.0, 1.0, 0.0)), kPeriod_s);
  StateSpaceState state(law.blocks());
  // First state for b = (1, 0) and v = 1: integral of e^{-st} cos(wt).
  const double norm = s * s + w * w;
  for (int n = 0; n < 400; ++n) {
    const double t = n * kPeriod_s;
    const double exact =
        (s + std::exp(-s * t) * (w * std::sin(w * t) - s * std::cos(w * t))) / norm;
    const LawOutput out = Step(law, state, {-1.0}, {}, kNoLimit_a);
    ASSERT_NEAR(out.control_current_a[0], exact, 1e-15 * 400) << n;
  }
}

TEST(StateSpaceLaw, AnIntegratorIsARampUnderAConstantInput) {
  const StateSpaceCoefficients law(OneAxis(Block(0.0, 0.0, 10.0, 0.0, 1.0, 0.0)), kPeriod_s);
  StateSpaceState state(law.blocks());
  LawOutput out;
  for (int n = 0; n < 201; ++n) out = Step(law, state, {-1.0}, {}, kNoLimit_a);
  EXPECT_NEAR(out.control_current_a[0], 10.0 * 200 * kPeriod_s, 1e-14);  // 200 roundings near 0.1
}

TEST(StateSpaceLaw, EqualsItsEquationsForCoupledAxesUpToTheMostStates) {
  Random draw(20261121);
  for (const auto& [axes, pairs, singles] : {std::array<std::size_t, 3>{1, 0, 0},
                                             {4, 8, 0},
                                             {4, 6, 4},
                                             {3, 1, 5},
                                             {8, 48, 0},
                                             {8, 0, 96}}) {
    const StateSpaceConfig config = RandomLaw(axes, pairs, singles, draw);
    const StateSpaceCoefficients law(config, kPeriod_s);
    StateSpaceState state(law.blocks());
    Textbook textbook(config);
    for (int n = 0; n < 300; ++n) {
      AxisArray error_m{};
      AxisArray excitation_a{};
      for (std::size_t i = 0; i < axes; ++i) {
        error_m[i] = draw.Normal();
        excitation_a[i] = draw.Normal();
      }
      const AxisArray expected = textbook.Step(error_m, excitation_a, 5.0);
      const LawOutput out = Step(law, state, error_m, excitation_a, 5.0);
      for (std::size_t i = 0; i < kMaxAxes; ++i) {
        // Sums of up to 800 products of numbers up to 10, in another order.
        ASSERT_NEAR(out.control_current_a[i], expected[i], 1e-11) << axes << " axes, cycle " << n;
      }
    }
  }
}

TEST(StateSpaceLaw, NeverExceedsTheLimitAndNamesTheAxesThatWantedMore) {
  Random draw(7);
  const StateSpaceConfig config = RandomLaw(4, 4, 0, draw);
  const StateSpaceCoefficients law(config, kPeriod_s);
  StateSpaceState state(law.blocks());
  int limited = 0;
  for (int n = 0; n < 10'000; ++n) {
    AxisArray error_m{draw.Normal(), draw.Normal(), draw.Normal(), draw.Normal()};
    const LawOutput out = Step(law, state, error_m, {}, 0.5);
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_LE(std::abs(out.control_current_a[i]), 0.5);
      const bool said = (out.saturated_axes >> i & 1U) != 0;
      if (said) {
        ASSERT_EQ(std::abs(out.control_current_a[i]), 0.5);
      }
      limited += said ? 1 : 0;
    }
  }
  EXPECT_GT(limited, 100);  // the limit was really met
}

// The harm: an integrator that runs on while the current is cut off needs as long to come back.
TEST(StateSpaceLaw, AnIntegratorComesBackAtOnceFromALimitItWasHeldAt) {
  const StateSpaceCoefficients law(OneAxis(Block(0.0, 0.0, 1000.0, 0.0, 1.0, 0.0)), kPeriod_s);
  StateSpaceState state(law.blocks());
  for (int n = 0; n < 10'000; ++n) (void)Step(law, state, {-1.0}, {}, 1.0);
  EXPECT_LE(state.first[0], 1.0 + 1000.0 * kPeriod_s);  // at most one period beyond the limit
  (void)Step(law, state, {+1.0}, {}, 1.0);
  (void)Step(law, state, {+1.0}, {}, 1.0);
  EXPECT_LT(Step(law, state, {+1.0}, {}, 1.0).control_current_a[0], 1.0);
}

// A robust law's slowest state decays at 0.4 1/s: without an integrator by name it winds up as one.
TEST(StateSpaceLaw, AStateThatForgetsSlowlyComesBackAtOnceTooWhereTheTextbooksStaysForSeconds) {
  // Beside a direct gain of 0.5 A per unit, a state that reaches 50 A in the long run.
  StateSpaceConfig config = OneAxis(Block(-0.4, 0.0, 20.0, 0.0, 1.0, 0.0));
  config.direct[0][0] = 0.5;
  const StateSpaceCoefficients law(config, kPeriod_s);
  StateSpaceState state(law.blocks());
  Textbook textbook(DiscretiseBlocks(config, kPeriod_s));
  constexpr double kLimit_a = 1.0;
  for (int n = 0; n < 20'000; ++n) {
    (void)Step(law, state, {-1.0}, {}, kLimit_a);
    (void)textbook.Step({-1.0}, {}, kLimit_a);
  }
  // The disturbance is over, the error a tenth the other way: half a second later.
  double now_a = 0.0;
  double textbook_a = 0.0;
  for (int n = 0; n < 5'000; ++n) {
    now_a = Step(law, state, {+0.1}, {}, kLimit_a).control_current_a[0];
    textbook_a = textbook.Step({+0.1}, {}, kLimit_a)[0];
  }
  EXPECT_LT(now_a, 0.1 * kLimit_a);
  EXPECT_EQ(textbook_a, kLimit_a);
}

// A block that forgets by itself is the linear law, limited or not.
TEST(StateSpaceLaw, AStableBlockRunsOnWhileItsAxisIsLimited) {
  const auto config = OneAxis(Block(-500.0, 2000.0, 100.0, 50.0, 1.0, 2.0));
  const StateSpaceCoefficients law(config, kPeriod_s);
  StateSpaceState limited(law.blocks());
  StateSpaceState free(law.blocks());
  for (int n = 0; n < 1000; ++n) {
    const double error_m = std::sin(0.01 * n);
    (void)Step(law, limited, {error_m}, {}, 1e-6);
    (void)Step(law, free, {error_m}, {}, kNoLimit_a);
    ASSERT_EQ(limited.first, free.first);
    ASSERT_EQ(limited.second, free.second);
  }
}

TEST(StateSpaceLaw, RunsBehindTheCommonStepAndStartsAnewAfterReset) {
  LawConfig config;
  config.period_s = kPeriod_s;
  config.state_space = OneAxis(Block(-500.0, 2000.0, 100.0, 50.0, 1.0, 2.0), 0.5);
  const LawCoefficients coefficients(config);
  EXPECT_EQ(coefficients.axes(), 1U);
  LawState state(coefficients);
  const LawOutput first = Step(coefficients, state, {1e-3}, {}, kNoLimit_a);
  const LawOutput second = Step(coefficients, state, {1e-3}, {}, kNoLimit_a);
  EXPECT_EQ(first.control_current_a[0], -0.5e-3);  // the direct path alone, its sign given
  EXPECT_NE(second.control_current_a[0], first.control_current_a[0]);
  state.Reset();
  EXPECT_EQ(Step(coefficients, state, {1e-3}, {}, kNoLimit_a).control_current_a,
            first.control_current_a);
}

TEST(StateSpaceLaw, AllocatesNothingInItsStep) {
  Random draw(3);
  LawConfig config;
  config.period_s = kPeriod_s;
  config.state_space = RandomLaw(8, 24, 0, draw);
  const LawCoefficients coefficients(config);
  LawState state(coefficients);
  const test::AllocationGuard guard;
  for (int n = 0; n < 10'000; ++n) (void)Step(coefficients, state, {1e-3, 2e-3}, {}, 1e-3);
  EXPECT_EQ(guard.count(), 0U);
}

TEST(StateSpaceLaw, RefusesWhatCannotBe) {
  const StateSpaceConfig good = OneAxis(Block(-500.0, 2000.0, 1.0, 1.0, 1.0, 1.0));
  const auto expect_refused = [](const StateSpaceConfig& law, double period_s) {
    EXPECT_THROW((void)StateSpaceCoefficients(law, period_s), std::invalid_argument);
  };
  expect_refused(good, 0.0);
  expect_refused(good, std::numeric_limits<double>::quiet_NaN());
  StateSpaceConfig law = good;
  law.axes = 0;
  expect_refused(law, kPeriod_s);
  law.axes = kMaxAxes + 1;
  expect_refused(law, kPeriod_s);
  law = good;
  law.blocks.resize(49, good.blocks[0]);  // 98 states
  expect_refused(law, kPeriod_s);
  law = good;
  law.blocks[0].second_output[0] = std::numeric_limits<double>::infinity();
  expect_refused(law, kPeriod_s);
}

}  // namespace
}  // namespace levitas::law
