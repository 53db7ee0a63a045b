// What a levitator's rig file or its healthy records say is where a search begins.

#include "diagnosis/levitator/origin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "diagnosis/levitator/coil_run.hpp"
#include "diagnosis/levitator/levitator_result.hpp"
#include "diagnosis/levitator/motion_run.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

using test::CarryingCurrent;
using test::Entry;
using test::LevitatorFile;
using test::StillSeries;

configuration::RigFile Holding(const std::vector<effect::EffectConfig>& effects) {
  configuration::RigFile file = LevitatorFile();
  file.plant.effects = effects;
  return file;
}

TEST(Origin, RatiosMultiplyAndAllElseAdds) {
  Theta origin = Zeros(0);
  origin[kMass] = 0.1;
  origin[kLoad] = 0.02;
  Theta theta = Zeros(1);
  theta[kMass] = 0.2;
  theta[kLoad] = 0.03;
  theta[Own(0, kOwnOffset)] = 5e-5;
  const Theta both = ComposedWith(origin, theta);
  EXPECT_NEAR(both[kMass], 1.1 * 1.2 - 1.0, 1e-15);
  EXPECT_NEAR(both[kLoad], 0.05, 1e-15);
  EXPECT_EQ(both[Own(0, kOwnOffset)], 5e-5);
}

// The model of a file that holds effects is that of the plain file with what they are.
TEST(Origin, EffectsOfTheFileDoWhatTheirNumbersDo) {
  const configuration::RigFile file =
      Holding({Entry(effect::Id::kStaticLoad, {0.0, 0.02, 0.0}),
               Entry(effect::Id::kRotorMass, {1.05}), Entry(effect::Id::kSensorGain, {0.98}),
               Entry(effect::Id::kSensorNonlinearity, {-20.0, 300.0})});
  const NominalRig with = NominalOf(file);
  const NominalRig plain = NominalOf(LevitatorFile());
  const Series series = StillSeries(400, 1.0, CarryingCurrent(plain, 1e-3), 1e-3);
  Theta theta = Zeros(1);
  theta[kLoad] = 0.02;
  theta[kMass] = 0.05;
  theta[kSensorGain] = -0.02;
  theta[kSensorSquare] = -20.0;
  theta[kSensorCube] = 300.0;
  const auto expected = Innovations(plain, series, theta, 0, RunCoils(plain, series, theta, 0));
  const auto found = Innovations(with, series, Zeros(1), 0, RunCoils(with, series, Zeros(1), 0));
  const auto without =
      Innovations(plain, series, Zeros(1), 0, RunCoils(plain, series, Zeros(1), 0));
  EXPECT_NEAR(found.back(), expected.back(), 1e-12);
  EXPECT_GT(std::abs(without.back() - expected.back()), 1e-5);
}

TEST(Origin, ACalibratedFileSaysOnceWhatItsOwnEffectsAndTheCausesAre) {
  const configuration::RigFile file = Holding({Entry(effect::Id::kStaticLoad, {0.0, 0.02, 0.0})});
  Found found;
  found.extended.theta = Zeros(1);
  found.extended.deviation = Zeros(1);
  found.extended.theta[kLoad] = 0.03;
  const configuration::RigFile read =
      configuration::ParseRig(CalibratedRig(file, OriginOf(file), found), "calibrated_rig.yaml");
  ASSERT_EQ(read.plant.effects.size(), 1U);
  EXPECT_EQ(read.plant.effects[0].id, effect::Id::kStaticLoad);
  EXPECT_NEAR(read.plant.effects[0].values[1], 0.05, 1e-6);
}

/// A size of each number that a rig file can hold, all of them at once.
Theta Everything() {
  Theta theta = Zeros(1);
  theta[kDelay] = 1.45;
  theta[kSupply] = 0.02;
  theta[kResistance] = -0.03;
  theta[kInductance] = 0.2;
  theta[kProfile] = 0.9;
  theta[kIronInductance] = 0.2;
  theta[kDeadBand] = 0.09;
  theta[kCommandUpper] = 0.04;
  theta[kDriveCurve] = -0.2;
  theta[kHeating] = 4e-3;
  theta[kMotionEmf] = -0.03;
  theta[kAwaySupply] = 0.3;
  theta[kAwayInductance] = -0.4;
  theta[kForce] = 0.1;
  theta[kForceDecay] = -0.04;
  theta[kForceKnee] = 0.05;
  theta[kForceLag] = 1e-3;
  theta[kForceAway] = 0.15;
  theta[kSensorGain] = -0.01;
  theta[kSensorOffset] = 2e-4;
  theta[kSensorSquare] = -20.0;
  theta[kSensorCube] = -1500.0;
  theta[kSensorLag] = 5e-4;
  theta[kMass] = 0.05;
  theta[kLoad] = 0.02;
  theta[kSpring] = 3.0;
  return theta;
}

configuration::RigFile Extended(const configuration::RigFile& file, const Theta& theta) {
  Found found;
  found.extended.theta = theta;
  found.extended.deviation = Zeros(1);
  return configuration::ParseRig(CalibratedRig(file, OriginOf(file), found), "calibrated_rig.yaml");
}

/// Both coils at work, neither probe's reading made by the model.
Series BothAtWork(const NominalRig& rig) {
  Series series = test::LivelySeries(rig, Zeros(1), 3000, 5);
  for (std::size_t n = 0; n < series.size(); ++n) {
    series.asked_a[1][n] = n % 70 < 30 ? 0.05 : 0.6;
  }
  series.idle = {false, false};
  return series;
}

double Farthest(const std::vector<double>& one, const std::vector<double>& other) {
  double most = 0.0;
  for (std::size_t n = 0; n < one.size(); ++n) most = std::max(most, std::abs(one[n] - other[n]));
  return most;
}

// Found, written, read back: the file alone then is the model that was found. One number at a time
// and all together.
TEST(Origin, AnExtendedFileIsTheModelThatWasFound) {
  const configuration::RigFile file = LevitatorFile();
  const NominalRig plain = NominalOf(file);
  const Series series = BothAtWork(plain);
  // Begun anew at every other row: a step of the ball without the observer, whose gains go by the
  // file's own decay.
  Series steps = series;
  for (std::size_t n = 0; n < steps.size(); ++n) steps.restart[n] = n % 2 == 0;
  std::vector<Theta> cases{Everything()};
  for (std::size_t i = 0; i < kParameters; ++i) {
    cases.push_back(Zeros(1));
    cases.back()[i] = Everything()[i];
  }
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const std::string name = c == 0 ? "all" : std::string(effect::At(Table()[c - 1].effect).name);
    const NominalRig read = NominalOf(Extended(file, cases[c]));
    const CoilRun found = RunCoils(plain, series, cases[c], 0);
    const CoilRun known = RunCoils(read, series, Zeros(1), 0);
    // Six digits of the entries of effects, where the keys have them all.
    EXPECT_LT(Farthest(found.reading_a[0], known.reading_a[0]), 1e-6) << name;
    EXPECT_LT(Farthest(found.reading_a[1], known.reading_a[1]), 1e-6) << name;
    // A hundred-thousandth of the weight moves the ball by 5e-11 m within a step.
    EXPECT_LT(Farthest(Innovations(plain, steps, cases[c], 0, found),
                       Innovations(read, steps, Zeros(1), 0, known)),
              5e-11)
        << name;
  }
}

TEST(Origin, AnExtendedFileOfAnExtendedFileHoldsEachNumberOnce) {
  const configuration::RigFile once = Extended(LevitatorFile(), Everything());
  const configuration::RigFile twice = Extended(once, Zeros(1));
  EXPECT_EQ(configuration::WriteRig(twice), configuration::WriteRig(once));
}

TEST(Origin, WhatIsInTheFileMayBeFoundToBeLess) {
  const configuration::RigFile file = Extended(LevitatorFile(), Everything());
  const Theta origin = OriginOf(file);
  EXPECT_NEAR(LowerBound(kDeadBand, origin[kDeadBand]), -0.09, 1e-12);
  EXPECT_EQ(LowerBound(kSupply, 0.3), Table()[kSupply].least);
  EXPECT_EQ(LowerBound(kDeadBand, 0.0), 0.0);
}

TEST(Origin, RefusesEffectsThatNoNumberStandsForAndThoseThatSetInLater) {
  EXPECT_THROW(static_cast<void>(EffectsOf(Holding({Entry(effect::Id::kUnbalance, {})}))),
               BadInput);
  effect::EffectConfig later = Entry(effect::Id::kStaticLoad, {0.0, 0.02, 0.0});
  later.at_s = 2.0;
  EXPECT_THROW(static_cast<void>(EffectsOf(Holding({later}))), BadInput);
}

}  // namespace
}  // namespace levitas::levitator
