// What a levitator's rig file or its healthy records say is where a search begins.

#include "diagnosis/levitator/origin.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/problem.hpp"
#include "diagnosis/levitator/answer.hpp"
#include "diagnosis/levitator/coil_run.hpp"
#include "diagnosis/levitator/motion_run.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

using test::CarryingCurrent;
using test::Entry;
using test::LevitatorFile;
using test::StillSeries;

config::RigFile Holding(const std::vector<effect::EffectConfig>& effects) {
  config::RigFile file = LevitatorFile();
  file.plant.effects = effects;
  return file;
}

TEST(Origin, RatiosMultiplyAndAllElseAdds) {
  Theta origin = Nominal(0);
  origin[kMass] = 0.1;
  origin[kLoad] = 0.02;
  Theta theta = Nominal(1);
  theta[kMass] = 0.2;
  theta[kLoad] = 0.03;
  theta[Own(0, kOwnOffset)] = 5e-5;
  const Theta both = Beside(origin, theta);
  EXPECT_NEAR(both[kMass], 1.1 * 1.2 - 1.0, 1e-15);
  EXPECT_NEAR(both[kLoad], 0.05, 1e-15);
  EXPECT_EQ(both[Own(0, kOwnOffset)], 5e-5);
}

// The model of a file that holds effects is that of the plain file with what they are.
TEST(Origin, EffectsOfTheFileDoWhatTheirNumbersDo) {
  const config::RigFile file =
      Holding({Entry(effect::Id::kStaticLoad, {0.0, 0.02, 0.0}),
               Entry(effect::Id::kRotorMass, {1.05}), Entry(effect::Id::kSensorGain, {0.98}),
               Entry(effect::Id::kSensorNonlinearity, {-20.0, 300.0})});
  const NominalRig with = NominalOf(file);
  const NominalRig plain = NominalOf(LevitatorFile());
  const Series series = StillSeries(400, 1.0, CarryingCurrent(plain, 1e-3), 1e-3);
  Theta theta = Nominal(1);
  theta[kLoad] = 0.02;
  theta[kMass] = 0.05;
  theta[kSensorGain] = -0.02;
  theta[kSensorSquare] = -20.0;
  theta[kSensorCube] = 300.0;
  const auto expected = Innovations(plain, series, theta, 0, RunCoils(plain, series, theta, 0));
  const auto found =
      Innovations(with, series, Nominal(1), 0, RunCoils(with, series, Nominal(1), 0));
  const auto without =
      Innovations(plain, series, Nominal(1), 0, RunCoils(plain, series, Nominal(1), 0));
  EXPECT_NEAR(found.back(), expected.back(), 1e-12);
  EXPECT_GT(std::abs(without.back() - expected.back()), 1e-5);
}

TEST(Origin, AnExtendedFileSaysOnceWhatItsOwnEffectsAndTheCausesAre) {
  const config::RigFile file = Holding({Entry(effect::Id::kStaticLoad, {0.0, 0.02, 0.0})});
  Found found;
  found.extended.theta = Nominal(1);
  found.extended.deviation = Nominal(1);
  found.extended.theta[kLoad] = 0.03;
  const config::RigFile read =
      config::ParseRig(ExtendedRig(file, EffectsOf(file), found), "extended_rig.yaml");
  ASSERT_EQ(read.plant.effects.size(), 1U);
  EXPECT_EQ(read.plant.effects[0].id, effect::Id::kStaticLoad);
  EXPECT_NEAR(read.plant.effects[0].values[1], 0.05, 1e-6);
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
