// The table of parameters of a ball between two magnets, and where their values stand.

#include "diagnosis/levitator/parameters.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::levitator {
namespace {

TEST(ParameterTable, HasItsRowsInTheOrderOfTheirNames) {
  EXPECT_EQ(Table().size(), static_cast<std::size_t>(kParameters));
  EXPECT_EQ(At(kDelay).effect, effect::Id::kExtraDelay);
  EXPECT_EQ(At(kAwayInductance).name, "ratio_away");
  EXPECT_EQ(At(kProbeGain).effect, effect::Id::kCurrentSensorGain);
  EXPECT_EQ(At(kForce).effect, effect::Id::kForceConstant);
  EXPECT_EQ(At(kForceAway).effect, effect::Id::kCoilAsymmetry);
  EXPECT_EQ(At(kSensorCube).name, "a3");
  EXPECT_EQ(At(kMass).effect, effect::Id::kRotorMass);
  EXPECT_EQ(At(kSpring).effect, effect::Id::kCouplingStiffness);
}

// The rig file is 0, so every bound must let it through; a ratio of -1 would be no coil at all.
TEST(ParameterTable, LetsEveryRigFileBeHealthyAndEveryCauseBeLargerThanItsTolerance) {
  std::set<std::pair<std::string, std::string>> names;
  for (const Row& row : Table()) {
    const std::string effect(effect::At(row.effect).name);
    EXPECT_LE(row.least, 0.0) << effect;
    EXPECT_GE(row.tolerance, 0.0) << effect;
    EXPECT_GT(row.wide, row.tolerance) << effect;
    if (row.name.starts_with("ratio")) {
      EXPECT_GT(row.least, -1.0) << effect;
    }
    EXPECT_TRUE(names.emplace(effect, row.name).second) << effect << " twice";
  }
}

TEST(ParameterTable, KeepsTheNumbersOfEachRecordApartBehindTheCommonOnes) {
  constexpr std::size_t kRecords = 3;
  const Theta zeros = Zeros(kRecords);
  std::set<std::size_t> places;
  for (std::size_t record = 0; record < kRecords; ++record) {
    for (const OwnParameter own : {kOwnResistance, kOwnOffset}) {
      const std::size_t at = Own(record, own);
      EXPECT_GE(at, static_cast<std::size_t>(kParameters));
      EXPECT_LT(at, zeros.size());
      EXPECT_TRUE(places.insert(at).second) << "one place for two numbers";
    }
  }
  EXPECT_EQ(zeros.size(), static_cast<std::size_t>(kParameters) + 2 * kRecords);
  EXPECT_EQ(zeros, Theta(zeros.size(), 0.0));
}

// The tables of docs/effects.md are those of a diagnosis, name by name.
TEST(ParameterTable, NamesWhatTheCatalogueNamesOfEffectsThatAreNoEntries) {
  std::set<std::pair<std::string, std::string>> fitted;
  std::set<std::pair<std::string, std::string>> listed;
  for (const Row& row : Table()) {
    const effect::Row& known = effect::At(row.effect);
    if (!effect::IsEntry(known)) fitted.emplace(known.name, row.name);
  }
  for (const effect::Row& known : effect::Catalogue()) {
    if (effect::IsEntry(known)) continue;
    for (const effect::Parameter& p : known.parameters) {
      listed.emplace(known.name, effect::FileKey(p));
    }
  }
  EXPECT_EQ(fitted, listed);
}

}  // namespace
}  // namespace levitas::levitator
