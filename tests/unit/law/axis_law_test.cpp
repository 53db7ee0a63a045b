#include "controller/law/axis_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/random.hpp"
#include "tests/unit/law/flexible_rotor_law.hpp"

namespace levitas::law {
namespace {

constexpr double kNoLimit = 1e30;

// The published cascade run sample by sample in direct form I and extended precision: another
// structure, another arithmetic, the PID first instead of last.
class Reference {
 public:
  explicit Reference(const AxisLawConfig& axis) : sections_(DiscreteSections(axis, kPeriodS)) {
    memory_.resize(sections_.size());
  }
  long double Step(long double in) {
    for (std::size_t k = 0; k < sections_.size(); ++k) {
      const Section& s = sections_[k];
      Memory& m = memory_[k];
      const long double out =
          s.b0 * in + s.b1 * m.in1 + s.b2 * m.in2 - s.a1 * m.out1 - s.a2 * m.out2;
      m = {in, m.in1, out, m.out1};
      in = out;
    }
    return in;
  }

 private:
  struct Memory {
    long double in1{}, in2{}, out1{}, out2{};
  };
  std::vector<Section> sections_;
  std::vector<Memory> memory_;
};

void ExpectReference(const LawConfig& config) {
  const LawCoefficients coefficients(config);
  LawState state(coefficients);
  std::vector<Reference> references(config.axes.begin(), config.axes.end());
  Random random(3);
  for (int n = 0; n < 5000; ++n) {
    AxisArray error_m{};
    for (std::size_t i = 0; i < config.axes.size(); ++i) error_m[i] = 1e-5 * random.Normal();
    const LawOutput out = Step(coefficients, state, error_m, {}, kNoLimit);
    ASSERT_EQ(out.saturated_axes, 0);
    for (std::size_t i = 0; i < config.axes.size(); ++i) {
      // Currents are about 1 A here. Rounding of the combined PID's coefficients (1e-11 A/m of
      // 1e5 A/m, integrated over 5000 samples of 1e-5 m) stays below 1e-10 A.
      ASSERT_NEAR(out.control_current_a[i], static_cast<double>(references[i].Step(error_m[i])),
                  1e-10)
          << "axis " << i << " sample " << n;
    }
  }
}

TEST(AxisLaw, GivesTheCurrentsOfTheDiscreteSections) { ExpectReference(FlexibleRotorLaw()); }

TEST(AxisLaw, TakesAxesWithChainsOfDifferentLength) {
  LawConfig config = FlexibleRotorLaw();
  config.axes[1].notches.push_back({1200.0, 0.1, 0.7});
  config.axes[2].notches.clear();
  config.axes[3].lead_lags.clear();
  config.axes[3].ki_a_per_m_s = 0.0;
  config.axes.push_back(FlexibleRotorAxis(0.5));  // a fifth axis: the eight-lane path
  config.axes.back().kd_a_s_per_m = 0.0;
  config.axes.push_back(FlexibleRotorAxis(3.0));
  config.axes.back().lead_lags.push_back({200.0, 300.0});
  ExpectReference(config);
}

TEST(AxisLaw, PushesAgainstTheDisplacement) {
  const LawCoefficients coefficients(FlexibleRotorLaw());
  LawState state(coefficients);
  // Rotor at +10 um, reference 0: error -10 um, the current must be negative on that axis only.
  const LawOutput out = Step(coefficients, state, {-1e-5, 0.0, 0.0, 0.0}, {}, 1.0);
  EXPECT_LT(out.control_current_a[0], 0.0);
  for (std::size_t i = 1; i < kMaxAxes; ++i) EXPECT_EQ(out.control_current_a[i], 0.0);
}

TEST(AxisLaw, NeverExceedsTheLimitForAnyInput) {
  const LawCoefficients coefficients(FlexibleRotorLaw());
  LawState state(coefficients);
  Random random(20261121);
  for (int n = 0; n < 100'000; ++n) {
    const double limit_a = 0.2 + random.Uniform();
    AxisArray error_m{};
    AxisArray excitation_a{};
    for (std::size_t i = 0; i < 4; ++i) {
      error_m[i] = std::pow(10.0, 10.0 * random.Uniform() - 9.0) * random.Normal();
      excitation_a[i] = random.Normal();
    }
    const LawOutput out = Step(coefficients, state, error_m, excitation_a, limit_a);
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_LE(std::abs(out.control_current_a[i]), limit_a);  // also false for NaN
      const bool flagged = (out.saturated_axes >> i & 1U) != 0;
      ASSERT_TRUE(!flagged || std::abs(out.control_current_a[i]) == limit_a);
    }
  }
}

TEST(AxisLaw, AddsTheExcitationBeforeTheLimit) {
  const LawCoefficients coefficients(FlexibleRotorLaw());
  LawState state(coefficients);
  EXPECT_EQ(Step(coefficients, state, {}, {0.25}, 1.0).control_current_a[0], 0.25);
  const LawOutput limited = Step(coefficients, state, {}, {0.0, 3.0}, 1.0);
  EXPECT_EQ(limited.control_current_a[1], 1.0);
  EXPECT_EQ(limited.saturated_axes, 0b10);
}

// The harm: with a plain integrator a rotor pressed to one side for a second leaves the integral
// at Ki times 1 s times 100 um = 2.4 A, far beyond the limit, and the current stays wrong after.
TEST(AntiWindupPair, APlainIntegratorWindsUpBeyondTheLimit) {
  const LawCoefficients coefficients(FlexibleRotorLaw());
  LawState state(coefficients);
  for (int n = 0; n < 10'000; ++n) (void)Step(coefficients, state, {1e-4}, {}, kNoLimit);
  EXPECT_NEAR(state.integral_a.at[0], 24128.6 * 1e-4 * 1.0, 1e-3);  // filters' first ms missing
}

TEST(AntiWindupPair, TheLimitedLawLeavesItsLimitAtOnce) {
  const LawCoefficients coefficients(FlexibleRotorLaw());
  LawState state(coefficients);
  constexpr double kLimitA = 0.4;  // below Kp e = 0.45 A
  for (int n = 0; n < 10'000; ++n) (void)Step(coefficients, state, {1e-4}, {}, kLimitA);
  EXPECT_LT(state.integral_a.at[0], kLimitA);
  LawOutput out;
  // 5 ms are ten time constants of the slowest filter (a notch, 1/(2 pi 449 Hz x 0.83) = 0.43 ms).
  for (int n = 0; n < 50; ++n) out = Step(coefficients, state, {-1e-5}, {}, kLimitA);
  EXPECT_EQ(out.saturated_axes, 0);
}

TEST(AntiWindup, DoesNotDisturbTheUnsaturatedLaw) {
  const LawCoefficients coefficients(FlexibleRotorLaw());
  LawState with(coefficients);
  LawState without(coefficients);
  Random random(5);
  for (int n = 0; n < 20'000; ++n) {
    AxisArray error_m{};
    for (std::size_t i = 0; i < 4; ++i) error_m[i] = 1e-7 * random.Normal();
    const LawOutput a = Step(coefficients, with, error_m, {}, 1.0);
    const LawOutput b = Step(coefficients, without, error_m, {}, kNoLimit);
    ASSERT_EQ(a.saturated_axes, 0);
    ASSERT_EQ(a.control_current_a, b.control_current_a);  // bit for bit
  }
}

TEST(AntiWindup, LetsTheIntegratorUnwindWhileLimited) {
  const LawCoefficients coefficients(FlexibleRotorLaw());
  LawState state(coefficients);
  state.integral_a.at[0] = 0.9;
  (void)Step(coefficients, state, {1e-3}, {}, 1.0);
  EXPECT_EQ(state.integral_a.at[0], 0.9);  // limited, and integrating would push further
  state.Reset();
  state.integral_a.at[0] = 5.0;
  const LawOutput out = Step(coefficients, state, {-1e-6}, {}, 1.0);
  EXPECT_EQ(out.saturated_axes, 1);        // still limited, 5 A wanted ...
  EXPECT_LT(state.integral_a.at[0], 5.0);  // ... but integrating leads back
}

TEST(LawState, IsAtRestAfterReset) {
  const LawCoefficients coefficients(FlexibleRotorLaw());
  LawState used(coefficients);
  LawState fresh(coefficients);
  for (int n = 0; n < 10; ++n) (void)Step(coefficients, used, {1e-4, 2e-4, 3e-4, 4e-4}, {}, 1.0);
  used.Reset();
  for (int n = 0; n < 10; ++n) {
    const AxisArray error_m{1e-5, -2e-5, 3e-5, 1e-6};
    EXPECT_EQ(Step(coefficients, used, error_m, {}, 1.0).control_current_a,
              Step(coefficients, fresh, error_m, {}, 1.0).control_current_a);
  }
}

TEST(LawCoefficients, RefuseNoAxesAndTooMany) {
  LawConfig config = FlexibleRotorLaw();
  config.axes.clear();
  EXPECT_THROW(LawCoefficients{config}, std::invalid_argument);
  config.axes.assign(kMaxAxes + 1, FlexibleRotorAxis());
  EXPECT_THROW(LawCoefficients{config}, std::invalid_argument);
}

}  // namespace
}  // namespace levitas::law
