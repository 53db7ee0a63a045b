// A first rig from six numbers: what follows from them, and that the files are ones that run.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "analysis/poles.hpp"
#include "cli/new_rig/ask.hpp"
#include "cli/new_rig/rig_sketch.hpp"
#include "cli/new_rig/start_law.hpp"
#include "cli/new_rig/strength.hpp"
#include "cli/run/loop_warning.hpp"
#include "common/problem.hpp"
#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"
#include "tests/unit/cli/own_sketch.hpp"

namespace levitas::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

configuration::RigFile RigOf(const RigSketch& sketch) {
  return configuration::ParseRig(SketchRig(sketch, "c.yaml", "s.yaml"), "own.yaml");
}

law::LawConfig LawOf(const RigSketch& sketch, const StartLaw& form) {
  return configuration::ParseController(SketchController(sketch, form), "c.yaml",
                                        RigOf(sketch).numbers)
      .law;
}

TEST(RigSketch, WeighsWhatItShouldAndCarriesItByTheLever) {
  RigSketch sketch = Sketch();
  sketch.bearings_mm = {100.0, 500.0};
  sketch.discs = {{600.0, 2.0, 100.0}};
  const SketchNumbers n = NumbersOf(sketch);
  EXPECT_DOUBLE_EQ(n.centre_mm, (6.0 * 300.0 + 2.0 * 600.0) / 8.0);
  EXPECT_DOUBLE_EQ(n.carried_kg[1], 8.0 * (375.0 - 100.0) / 400.0);
  EXPECT_DOUBLE_EQ(n.carried_kg[0] + n.carried_kg[1], 8.0);
  EXPECT_DOUBLE_EQ(n.ks_n_per_m, 60.0 * 2.0 / 0.4e-3);
  const double section_m2 = 0.25 * std::numbers::pi * n.diameter_mm * n.diameter_mm * 1e-6;
  EXPECT_NEAR(7850.0 * section_m2 * 0.6, 6.0, 1e-9);
}

// The rig file gives the coil; ki and ks that amb new rig computes are those that the file means.
TEST(RigSketch, OfACoilHasTheStrengthOfItsRigFile) {
  RigSketch sketch = Sketch();
  const double area_m2 = 420e-6, gap_m = 0.5e-3, turns = 110.0, bias_a = 3.0;
  const double along = std::cos(std::numbers::pi / 8.0);
  sketch.gap_mm = 1e3 * gap_m;
  sketch.bias_a = bias_a;
  sketch.turns = turns;
  sketch.pole_area_mm2 = 1e6 * area_m2;
  // docs/derivations.md (16a): ki as of a pole on the axis, times cos; ks times its square.
  const double on_axis =
      4e-7 * std::numbers::pi * turns * turns * area_m2 * bias_a / (gap_m * gap_m);
  sketch.ki_n_per_a = on_axis * along;
  const auto rig = RigOf(sketch);
  const auto& magnet = rig.plant.bearings.front().magnet;
  const double ki =
      4.0 * magnet.force_constant_n_m2_per_a2 * bias_a / (magnet.gap_m * magnet.gap_m);
  EXPECT_NEAR(ki, sketch.ki_n_per_a, 1e-3 * ki);
  EXPECT_NEAR(ki * bias_a / magnet.gap_m, NumbersOf(sketch).ks_n_per_m, 1e-3 * ki * bias_a / gap_m);
}

// Ip = 2 Id of a thin disc: each rounded by itself, every fourth file would be refused.
TEST(RigSketch, HasDiscsWhoseInertiaABodyCanHave) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    RigSketch sketch = Sketch();
    sketch.discs = {{300.0, 0.5 + 5.0 * random.Uniform(), 100.0 + 300.0 * random.Uniform()}};
    const auto disc = RigOf(sketch).plant.rotor.discs.front();
    EXPECT_NEAR(disc.polar_inertia_kg_m2 / disc.diametral_inertia_kg_m2, 2.0, 1e-8);
  }
}

TEST(RigSketch, IsARigThatTheStrictReaderTakes) {
  RigSketch sketch = Sketch();
  sketch.discs = {{585.0, 1.5, 180.0}};
  const configuration::RigFile rig = RigOf(sketch);
  EXPECT_EQ(rig.numbers.channels.size(), 4U);
  EXPECT_EQ(rig.run.controller, "./c.yaml");
  EXPECT_NEAR(rig.numbers.max_speed_rad_per_s, RpmToRadPerS(12'000.0), 1e-9);
  // G 2.5: e omega = 2.5 mm/s, half of the rotor at each bearing.
  EXPECT_NEAR(rig.plant.unbalance[0].moment_kg_m,
              0.5 * 8.0 * 2.5e-3 / rig.numbers.max_speed_rad_per_s, 2e-9);
  EXPECT_NEAR(rig.plant.bearings[0].touchdown.clearance_m, 0.2e-3, 1e-12);
  // Where a wheel sits its unbalance does, too: a plane to look for it.
  ASSERT_EQ(rig.plant.unbalance.size(), 3U);
  EXPECT_NEAR(rig.plant.unbalance[2].z_m, 0.585, 1e-12);
  EXPECT_EQ(rig.plant.unbalance[2].moment_kg_m, 0.0);
  sketch.discs[0].z_mm =
      NumbersOf(sketch).bearings_mm[1] + 1.0;  // in the plane of a bearing, which has one
  EXPECT_EQ(RigOf(sketch).plant.unbalance.size(), 2U);
  sketch.vertical = true;
  EXPECT_EQ(RigOf(sketch).plant.gravity_m_per_s2, 0.0);
}

// The weight of a shaft that stands is none of its radial bearings', in no comment and no line.
TEST(RigSketch, SpeaksOfWeightOnlyWhereTheBearingsCarryIt) {
  RigSketch sketch = Sketch();
  const auto told = [](const RigSketch& s) {
    return SketchRig(s, "c.yaml", "s.yaml") + SketchController(s, {}) + LoadsText(s, NumbersOf(s));
  };
  EXPECT_THAT(told(sketch), AllOf(HasSubstr("carries 4 kg"), HasSubstr("carries the weight within"),
                                  HasSubstr("front bearing carries 39.2 N"),
                                  HasSubstr("45 degrees to the vertical")));
  sketch.vertical = true;
  EXPECT_THAT(told(sketch),
              AllOf(HasSubstr("guides 4 kg, carries no weight"), HasSubstr("the shaft stands"),
                    HasSubstr("takes up a steady force within"), Not(HasSubstr("carries 4 kg")),
                    Not(HasSubstr("carries the weight within")), Not(HasSubstr("0.0 N")),
                    Not(HasSubstr("45 degrees to the vertical"))));
}

TEST(RigSketch, RefusesWhatNoRotorIs) {
  RigSketch sketch = Sketch();
  sketch.discs = {{100.0, 8.0, 50.0}};
  EXPECT_THROW(static_cast<void>(NumbersOf(sketch)), BadInput);
  sketch = Sketch();
  sketch.bearings_mm = {300.0, 300.0};
  EXPECT_THROW(static_cast<void>(NumbersOf(sketch)), BadInput);
}

/// The bending modes of this spindle make the usual form unstable.
TEST(StartLaw, HoldsASpindleThatTheUsualFormDoesNot) {
  RigSketch sketch = Sketch();
  sketch.bearings_mm = {120.0, 460.0};
  sketch.discs = {{585.0, 1.5, 180.0}};
  sketch.amplifier_hz = 2000.0;
  const configuration::RigFile rig = RigOf(sketch);
  const StartLaw chosen = ChooseStartLaw(sketch, rig);
  for (const double speed : {0.0, rig.numbers.max_speed_rad_per_s}) {
    EXPECT_FALSE(analysis::ClosedLoopPoles(rig.plant, LawOf(sketch, {}), speed).stable);
    EXPECT_TRUE(analysis::ClosedLoopPoles(rig.plant, LawOf(sketch, chosen), speed).stable);
  }
  const std::vector<double> speeds{0.0, rig.numbers.max_speed_rad_per_s};
  EXPECT_EQ(UnstableLoop(rig, LawOf(sketch, chosen), speeds, "r", "c"), "");
  EXPECT_THAT(UnstableLoop(rig, LawOf(sketch, {}), speeds, "r.yaml", "c.yaml"),
              AllOf(HasSubstr("unstable at rest: a pole at 11"), HasSubstr("grows e-fold every"),
                    HasSubstr("amb poles --rig r.yaml --controller c.yaml --speed-rpm 0"),
                    HasSubstr("amb design pid --rig r.yaml --out")));
}

TEST(LoopWarning, NamesTooLittleStiffnessAsWhatItIs) {
  const RigSketch sketch = Sketch();
  law::LawConfig law = LawOf(sketch, {});
  // Below ks/ki = 5000 A/m the magnet wins, without oscillation.
  for (auto& axis : law.axes) axis.kp_a_per_m = 4000.0, axis.ki_a_per_m_s = 0.0;
  EXPECT_THAT(UnstableLoop(RigOf(sketch), law, {0.0}, "r", "c"),
              HasSubstr("too little stiffness against the magnets'"));
}

TEST(LoopWarning, LooksAtStandstillAndTheFastestSpeedOfTheScenario) {
  scenario::ScenarioConfig scenario;
  EXPECT_THAT(ScenarioSpeeds(scenario), testing::ElementsAre(0.0));
  scenario.steps.resize(3);
  scenario.steps[1].speed_rad_per_s = -300.0;
  scenario.steps[2].speed_rad_per_s = 100.0;
  EXPECT_THAT(ScenarioSpeeds(scenario), testing::ElementsAre(0.0, 300.0));
}

TEST(Ask, TakesTheFirstAnswerThatIsANumberInRange) {
  const Question mass{"--mass-kg", "mass [kg]", 1.0, 10.0};
  const auto answered = [&](const std::string& typed) {
    std::string text = typed;
    std::FILE* in = fmemopen(text.data(), text.size(), "r");
    std::FILE* out = std::fopen("/dev/null", "w");
    double value = -1.0;
    try {
      value = Ask(mass, in, out);
    } catch (const Problem& refused) {
      EXPECT_EQ(refused.status(), ExitStatus::kUsage);
      EXPECT_THAT(refused.what(), HasSubstr("--mass-kg"));
    }
    std::fclose(in);
    std::fclose(out);
    return value;
  };
  EXPECT_EQ(answered("8\n"), 8.0);
  EXPECT_EQ(answered("eight\n11\n 2.5 \n"), 2.5);
  EXPECT_EQ(answered("nan\n0\n-1\n5\n"), -1.0) << "three answers are enough";
  EXPECT_EQ(answered("\n"), -1.0);
}

}  // namespace
}  // namespace levitas::cli
