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

namespace levitas::cli {
namespace {

struct Made {
  RigSketch sketch{.name = "own",
                   .mass_kg = 8.0,
                   .length_mm = 600.0,
                   .max_speed_rpm = 12'000.0,
                   .ki_n_per_a = 60.0,
                   .gap_mm = 0.4,
                   .bias_a = 2.0,
                   .bearings_mm = {120.0, 460.0},
                   .discs = {{585.0, 1.5, 180.0}}};
  config::RigFile rig;
  law::LawConfig law;
  TestSignal signal;
};

Made MakeRig(double rate_hz = 10'000.0, double gap_mm = 0.4) {
  Made made;
  made.sketch.rate_hz = rate_hz;
  made.sketch.gap_mm = gap_mm;
  made.rig = config::ParseRig(SketchRig(made.sketch, "c.yaml", "s.yaml"), "own.yaml");
  made.law =
      config::ParseController(SketchController(made.sketch, ChooseStartLaw(made.sketch, made.rig)),
                              "c.yaml", made.rig.numbers)
          .law;
  made.signal = TestSignalOf(made.rig, made.law);
  return made;
}

TEST(TestSignal, NeverTakesMoreThanATenthOfTheBias) {
  const Made made = MakeRig();
  EXPECT_GT(made.signal.amplitude_a, 0.0);
  EXPECT_LE(made.signal.amplitude_a, 0.2 + 1e-12);
  EXPECT_NEAR(made.signal.orbit_limit_m, 0.4 * 0.2e-3, 1e-12);
}

/// With a gap of a tenth the same ampere moves the rotor by a larger share of its clearance.
TEST(TestSignal, BecomesSmallerWithTheClearance) {
  Made made = MakeRig();
  for (auto& bearing : made.rig.plant.bearings) bearing.touchdown.clearance_m *= 0.01;
  const TestSignal small = TestSignalOf(made.rig, made.law);
  EXPECT_LT(small.amplitude_a, 0.5 * made.signal.amplitude_a);
}

TEST(TestSignal, StaysAwayFromCriticalSpeeds) {
  const Made made = MakeRig();
  const double top = made.rig.numbers.max_speed_rad_per_s;
  ASSERT_EQ(made.signal.speeds_rad_per_s.size(), 2U);
  EXPECT_LT(made.signal.speeds_rad_per_s[0], made.signal.speeds_rad_per_s[1]);
  const auto crossings = analysis::LevitatedCampbell(made.rig.plant, made.law, top).crossings;
  ASSERT_FALSE(crossings.empty());
  for (const double speed : made.signal.speeds_rad_per_s) {
    EXPECT_GT(speed, 0.1 * top);
    EXPECT_LE(speed, 0.5 * top);
    for (const auto& crossing : crossings) {
      EXPECT_GE(std::abs(speed - crossing.speed_rad_per_s), 0.12 * crossing.speed_rad_per_s);
    }
  }
}

TEST(TestSignal, HasPeriodsOfAboutASecondAtAnyRate) {
  for (const double rate_hz : {2'000.0, 10'000.0, 40'000.0}) {
    const Made made = MakeRig(rate_hz);
    const double period_s =
        (std::exp2(made.signal.order) - 1.0) * made.signal.divisor / made.sketch.rate_hz;
    EXPECT_GT(period_s, 0.5) << rate_hz;
    EXPECT_LT(period_s, 1.2) << rate_hz;
  }
}

TEST(TestSignal, IsAScenarioThatExcitesEveryAxisAtEachSpeed) {
  const Made made = MakeRig();
  const auto scenario = config::ParseScenario(SketchIdentify(made.sketch, made.rig, made.signal),
                                              "s.yaml", made.rig.numbers);
  std::size_t excited = 0;
  for (const auto& step : scenario.steps) excited += step.excitation.size();
  EXPECT_EQ(excited, 3 * made.rig.numbers.channels.size());
}

}  // namespace
}  // namespace levitas::cli
