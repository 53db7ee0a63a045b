// Test signals of a new rig: an amplitude that its loop bears, away from critical speeds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/critical_speeds.hpp"
#include "cli/new_rig/rig_sketch.hpp"
#include "cli/new_rig/start_law.hpp"
#include "cli/new_rig/test_signal.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"
#include "tests/unit/cli/own_sketch.hpp"

namespace levitas::cli {
namespace {

struct Made {
  RigSketch sketch;
  configuration::RigFile rig;
  law::LawConfig law;
  TestSignal signal;
};

Made MakeRig(double rate_hz = 10'000.0) {
  Made made{.sketch = Sketch(), .rig = {}, .law = {}, .signal = {}};
  made.sketch.bearings_mm = {120.0, 460.0};
  made.sketch.discs = {{585.0, 1.5, 180.0}};
  made.sketch.rate_hz = rate_hz;
  made.rig = configuration::ParseRig(SketchRig(made.sketch, "c.yaml", "s.yaml"), "own.yaml");
  made.law = configuration::ParseController(
                 SketchController(made.sketch, ChooseStartLaw(made.sketch, made.rig)), "c.yaml",
                 made.rig.numbers)
                 .law;
  made.signal = TestSignalOf(made.rig, made.law);
  return made;
}

/// At the rate of the sketch. Its law is a search of seconds, many times that under a sanitizer.
const Made& HealthyParameters() {
  static const Made made = MakeRig();
  return made;
}

TEST(TestSignal, NeverTakesMoreThanATenthOfTheBias) {
  const Made& made = HealthyParameters();
  EXPECT_GT(made.signal.amplitude_a, 0.0);
  EXPECT_LE(made.signal.amplitude_a, 0.2 + 1e-12);
  EXPECT_NEAR(made.signal.orbit_limit_m, 0.4 * 0.2e-3, 1e-12);
}

/// Where the clearance is what limits it, the amplitude is in proportion to it.
TEST(TestSignal, MovesTheRotorByAShareOfItsClearance) {
  Made made = HealthyParameters();
  const auto with_clearance = [&made](double clearance_m) {
    for (auto& bearing : made.rig.plant.bearings) bearing.touchdown.clearance_m = clearance_m;
    return TestSignalOf(made.rig, made.law).amplitude_a;
  };
  const double small = with_clearance(10e-6);
  ASSERT_LT(small, 0.1 * made.sketch.bias_a);
  // Two figures, rounded down: up to a tenth is lost.
  EXPECT_NEAR(with_clearance(5e-6), 0.5 * small, 0.1 * small);
}

TEST(TestSignal, StaysAwayFromCriticalSpeeds) {
  Made made = HealthyParameters();
  const double top = made.rig.numbers.max_speed_rad_per_s;
  const auto crossings = analysis::LevitatedCampbell(made.rig.plant, made.law, top).crossings;
  ASSERT_FALSE(crossings.empty());
  const double critical = crossings.front().speed_rad_per_s;
  // A quarter of this top speed, and half of this one, would be the critical one.
  for (const double share : {0.25, 0.5}) {
    made.rig.numbers.max_speed_rad_per_s = critical / share;
    const TestSignal signal = TestSignalOf(made.rig, made.law);
    ASSERT_FALSE(signal.speeds_rad_per_s.empty());
    for (const double speed : signal.speeds_rad_per_s) {
      // The sweep of another top speed finds the same crossing to 1e-9 of it.
      EXPECT_GE(std::abs(speed - critical), (0.12 - 1e-6) * critical) << share;
      EXPECT_LE(speed, 0.75 * critical / share);
    }
  }
}

TEST(TestSignal, IsOverWhenItSays) {
  const Made& made = HealthyParameters();
  const auto scenario = configuration::ParseScenario(
      SketchIdentify(made.sketch, made.rig, made.signal), "s.yaml", made.rig.numbers);
  double held_s = 0.0;
  for (const auto& step : scenario.steps) held_s += step.hold_s;
  const double said_s = DurationOf(made.sketch, made.rig, made.signal);
  EXPECT_GT(said_s, held_s);
  EXPECT_LT(said_s, held_s + 20.0);  // twice ten seconds to half of the top speed
}

TEST(TestSignal, HasPeriodsOfAboutASecondAtAnyRate) {
  const Made slow = MakeRig(2'000.0);
  const Made fast = MakeRig(40'000.0);
  for (const Made* made : {&slow, &HealthyParameters(), &fast}) {
    const double rate_hz = made->sketch.rate_hz;
    const double period_s = (std::exp2(made->signal.order) - 1.0) * made->signal.divisor / rate_hz;
    EXPECT_GT(period_s, 0.5) << rate_hz;
    EXPECT_LT(period_s, 1.2) << rate_hz;
  }
}

TEST(TestSignal, IsAScenarioThatExcitesEveryAxisAtEachSpeed) {
  const Made& made = HealthyParameters();
  const auto scenario = configuration::ParseScenario(
      SketchIdentify(made.sketch, made.rig, made.signal), "s.yaml", made.rig.numbers);
  std::size_t excited = 0;
  for (const auto& step : scenario.steps) excited += step.excitation.size();
  EXPECT_EQ(excited, 3 * made.rig.numbers.channels.size());
}

}  // namespace
}  // namespace levitas::cli
