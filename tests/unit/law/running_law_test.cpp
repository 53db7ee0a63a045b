// The law that runs: rungs of a schedule, and laws of unlike structure that change places.

#include "controller/law/running_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/random.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/unit/law/flexible_rotor_law.hpp"

namespace levitas::law {
namespace {

constexpr double kExchangeAt = 100.0;  // rad/s
constexpr double kAbove = 120.0;
constexpr double kNoLimit = 1e30;

LawConfig TimesAt(double factor, double speed) {
  LawConfig config = FlexibleRotorLaw();
  LawAtSpeed fast{speed, config.axes, {}};
  for (AxisLawConfig& axis : fast.axes) {
    axis.kp_a_per_m *= factor;
    axis.ki_a_per_m_s *= factor;
    axis.kd_a_s_per_m *= factor;
  }
  config.schedule = {fast};
  return config;
}

/// A law without filters, with an integrator or without, from kExchangeAt on.
LawConfig ToPlain(double ki_share = 1.0) {
  LawConfig config = FlexibleRotorLaw();
  LawAtSpeed plain{kExchangeAt, config.axes, {}, true};
  for (AxisLawConfig& axis : plain.axes) {
    axis.notches.clear();
    axis.lead_lags.clear();
    axis.kp_a_per_m = 6000.0;
    axis.ki_a_per_m_s *= ki_share;
  }
  config.schedule = {plain};
  return config;
}

LawConfig PlainAlone() {
  LawConfig config = ToPlain();
  config.axes = config.schedule[0].axes;
  config.schedule.clear();
  return config;
}

AxisArray Error(double first_m) {
  AxisArray error_m{};
  error_m[0] = first_m;
  return error_m;
}

double Current(RunningLaw& law, double speed, double error_m) {
  return law.Step(speed, Error(error_m), {}, kNoLimit).control_current_a[0];
}

TEST(RunningLaw, OfOneLawIsThatLaw) {
  const LawConfig config = FlexibleRotorLaw();
  RunningLaw running(config);
  const LawCoefficients plain(config);
  LawState state(plain);
  Random random(3);
  for (int n = 0; n < 500; ++n) {
    const AxisArray error_m = Error(1e-5 * random.Normal());
    const LawOutput one = running.Step(1000.0, error_m, {}, 1.0);
    const LawOutput other = Step(plain, state, error_m, {}, 1.0);
    ASSERT_EQ(one.control_current_a, other.control_current_a) << n;
  }
}

TEST(RunningLaw, OfASpeedThatStandsIsTheLawThatAnalysesTake) {
  const LawConfig config = TimesAt(3.0, 600.0);
  RunningLaw running(config);
  running.Start(222.0);
  const LawCoefficients plain(LawAt(config, 222.0));
  LawState state(plain);
  Random random(4);
  for (int n = 0; n < 500; ++n) {
    const AxisArray error_m = Error(1e-5 * random.Normal());
    const LawOutput one = running.Step(222.0, error_m, {}, 1.0);
    ASSERT_EQ(one.control_current_a, Step(plain, state, error_m, {}, 1.0).control_current_a) << n;
  }
}

// 20 um at 4514 A/m become four times as much: 0.27 A at once, a 256th of it rung by rung.
TEST(RunningLaw, ChangesAlongAScheduleWithoutABump) {
  const LawConfig config = TimesAt(4.0, 600.0);
  RunningLaw running(config);
  RunningLaw jumping(config);
  double largest_a = 0.0;
  double last_a = 0.0;
  double before_a = 0.0;
  for (int n = 0; n < 3000; ++n) {
    const double now_a = Current(running, n < 2000 ? 0.0 : 600.0, 20e-6);
    if (n >= 2000) largest_a = std::max(largest_a, std::abs(now_a - last_a));
    last_a = now_a;
    if (n < 2000) before_a = Current(jumping, 0.0, 20e-6);
  }
  EXPECT_LT(largest_a, 0.01);
  jumping.JumpTo(600.0);
  EXPECT_GT(std::abs(Current(jumping, 600.0, 20e-6) - before_a), 0.2);
}

/// The current across an exchange while an integrator carries 0.3 A at no error.
struct Carried {
  explicit Carried(const LawConfig& config) : law(config) {
    double current_a = 0.0;
    while (current_a < 0.3) current_a = Current(law, 0.0, 20e-6);
    for (int n = 0; n < 3000; ++n) carried_a = Current(law, 0.0, 0.0);
  }
  RunningLaw law;
  double carried_a{};
};

TEST(RunningLaw, AnIntegratorTakesOverTheCurrentThatWasCarried) {
  Carried run(ToPlain());
  ASSERT_GT(run.carried_a, 0.2);
  for (int n = 0; n < 5000; ++n) {
    // e^-5 of it had not been followed when the new law began to act.
    ASSERT_NEAR(Current(run.law, kAbove, 0.0), run.carried_a, 0.01 * run.carried_a) << n;
  }
  EXPECT_EQ(run.law.rung(), kRungs - 1);
}

TEST(RunningLaw, BesideALawWithoutIntegratorTheCurrentThatWasCarriedFades) {
  Carried run(ToPlain(0.0));
  const int until_it_acts =
      static_cast<int>(kRungs) + static_cast<int>(std::lround(kListenS / kPeriodS));
  double largest_a = 0.0;
  double last_a = run.carried_a;
  const int second = static_cast<int>(std::lround(kFadeS / kPeriodS));
  for (int n = 0; n < until_it_acts + second; ++n) {
    const double now_a = Current(run.law, kAbove, 0.0);
    largest_a = std::max(largest_a, std::abs(now_a - last_a));
    last_a = now_a;
  }
  EXPECT_LT(largest_a, 0.01 * run.carried_a);
  EXPECT_NEAR(last_a, run.carried_a / std::exp(1.0), 0.01 * run.carried_a);
}

TEST(RunningLaw, WithoutListeningTheCurrentThatWasCarriedIsLost) {
  Carried run(ToPlain());
  run.law.Start(kAbove);
  EXPECT_EQ(Current(run.law, kAbove, 0.0), 0.0);
}

TEST(RunningLaw, AfterAnExchangeIsTheNewLawAlone) {
  RunningLaw running(ToPlain());
  for (int n = 0; n < 2000; ++n) (void)Current(running, kAbove, 0.0);
  const LawCoefficients plain(PlainAlone());
  LawState state(plain);
  Random random(5);
  for (int n = 0; n < 500; ++n) {
    const AxisArray error_m = Error(1e-5 * random.Normal());
    const LawOutput one = running.Step(kAbove, error_m, {}, 1.0);
    ASSERT_EQ(one.control_current_a, Step(plain, state, error_m, {}, 1.0).control_current_a) << n;
  }
}

TEST(RunningLaw, ASpeedThatGoesBackCallsTheExchangeOff) {
  RunningLaw running(ToPlain());
  const auto listen = static_cast<int>(std::lround(kListenS / kPeriodS));
  for (int n = 0; n < static_cast<int>(kRungs) + listen / 2; ++n)
    (void)Current(running, kAbove, 0.0);
  const std::size_t below = running.rung();
  EXPECT_EQ(below, kRungs - 2) << "it listens";
  for (int n = 0; n < 10; ++n) (void)Current(running, 0.99 * kExchangeAt, 0.0);
  for (int n = 0; n < listen / 2 + 10; ++n) (void)Current(running, kAbove, 0.0);
  EXPECT_LT(running.rung(), kRungs - 1) << "it began to listen anew";
  for (int n = 0; n < listen; ++n) (void)Current(running, kAbove, 0.0);
  EXPECT_EQ(running.rung(), kRungs - 1);
}

TEST(RunningLaw, ASpeedThatIsNoNumberChangesNothing) {
  RunningLaw running(ToPlain());
  for (int n = 0; n < 5000; ++n) {
    (void)Current(running, std::numeric_limits<double>::quiet_NaN(), 1e-6);
  }
  EXPECT_EQ(running.rung(), 0U);
}

TEST(RunningLaw, TheLimitHoldsForWhatFadesToo) {
  Carried run(ToPlain(0.0));
  for (int n = 0; n < 3000; ++n) {
    ASSERT_LE(run.law.Step(kAbove, Error(30e-6), {}, 0.25).control_current_a[0], 0.25) << n;
  }
}

TEST(RunningLaw, AllocatesNothing) {
  RunningLaw running(ToPlain());
  const test::AllocationGuard guard;
  for (int n = 0; n < 3000; ++n) (void)running.Step(kAbove, {}, {}, 1.0);
  running.JumpTo(0.0);
  running.Start(kAbove);
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace levitas::law
