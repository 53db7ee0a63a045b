// Exchange among three causes, of two wrong ones, and what is not tried in the place of one.

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "diagnosis/inference/exchange.hpp"
#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;
using Effects = ToyLandscape::Effects;

/// Three readings with a cause each, and for each of them a wrong one, which also moves a fourth
/// that nothing moved.
struct ThreeToExchange {
  ToyLandscape toy{{10.0, 9.0, 8.0, 0.0}};
  Hypothesis x = toy.Add(Id::kUnbalance, {1.0, 0.0, 0.0, 0.0});
  Hypothesis y = toy.Add(Id::kShaftBow, {0.0, 1.0, 0.0, 0.0});
  Hypothesis z = toy.Add(Id::kMisalignment, {0.0, 0.0, 1.0, 0.0});
  Hypothesis not_x = toy.Add(Id::kSensorRunout, {1.0, 0.0, 0.0, 0.4});
  Hypothesis not_y = toy.Add(Id::kStaticLoad, {0.0, 1.0, 0.0, 0.4});
  Hypothesis not_z = toy.Add(Id::kSensorOffset, {0.0, 0.0, 1.0, 0.4});

  [[nodiscard]] CauseSelection Exchanged(const std::vector<Hypothesis>& causes) {
    CauseSelection found = toy.Found(causes);
    ExchangeCauses(toy, ThoroughRules(), found);
    return found;
  }
};

TEST(ExchangeOfThree, ReplacesTheThirdAlone) {
  ThreeToExchange three;
  const CauseSelection found = three.Exchanged({three.x, three.y, three.not_z});
  ASSERT_EQ(found.causes.size(), 3U);
  EXPECT_EQ(found.causes[0].effect, three.x.effect);
  EXPECT_EQ(found.causes[1].effect, three.y.effect);
  EXPECT_EQ(found.causes[2].effect, three.z.effect);
  EXPECT_NEAR(found.point.theta[three.z.terms.front()], 8.0, 1e-9);
  EXPECT_NEAR(found.point.theta[three.not_z.terms.front()], 0.0, 1e-9);
}

// One in a round: linearised before and after each exchange, for the next one is judged anew.
TEST(ExchangeOfThree, ReplacesTwoInTwoRounds) {
  ThreeToExchange three;
  const CauseSelection found = three.Exchanged({three.x, three.not_y, three.not_z});
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes),
            (Effects{three.x.effect, three.y.effect, three.z.effect}));
  EXPECT_NEAR(found.point.theta[three.y.terms.front()], 9.0, 1e-9);
  EXPECT_EQ(three.toy.linearised.size(), 4U);
}

TEST(ExchangeOfThree, EndsAfterARoundWithoutABetterOne) {
  ThreeToExchange three;
  const CauseSelection found = three.Exchanged({three.x, three.y, three.z});
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes),
            (Effects{three.x.effect, three.y.effect, three.z.effect}));
  EXPECT_EQ(three.toy.linearised.size(), 1U);
  EXPECT_TRUE(WasFitted(three.toy, {three.x.effect, three.y.effect, three.not_z.effect}));
}

TEST(ExchangeOfThree, PassesOverAnAlternativeThatCannotBeFitted) {
  ThreeToExchange three;
  three.toy.refused.insert({three.x.effect, three.y.effect, three.z.effect});
  const CauseSelection found = three.Exchanged({three.x, three.y, three.not_z});
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes),
            (Effects{three.x.effect, three.y.effect, three.not_z.effect}));
}

TEST(ExchangeOfThree, RefinesTheShapesOfAllOfThemTogether) {
  ThreeToExchange three;
  three.toy.shape = {{three.x.effect, 2.0}, {three.z.effect, 3.0}};
  const CauseSelection found = three.Exchanged({three.x, three.y, three.z});
  EXPECT_EQ(three.toy.PlaceAt(found.point, found.causes[0]), "at its shape");
  EXPECT_EQ(three.toy.PlaceAt(found.point, found.causes[1]), "here");
  EXPECT_EQ(three.toy.PlaceAt(found.point, found.causes[2]), "at its shape");
}

// The twin explains as much as the second cause beside the first; two of one effect are one.
TEST(ExchangeOfTwo, NeverPutsAnEffectInItsOwnPlaceOrThatOfTheOther) {
  ToyLandscape toy({10.0, 9.0});
  const Hypothesis x = toy.Add(Id::kUnbalance, {1.0, 0.0}, "de");
  toy.Add(Id::kUnbalance, {0.1, 1.0}, "nde");
  const Hypothesis y = toy.Add(Id::kShaftBow, {0.3, 1.0});
  CauseSelection found = toy.Found({x, y});
  ExchangeCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), (Effects{x.effect, y.effect}));
  EXPECT_EQ(found.causes.front().place, "de");
  for (const Effects& set : toy.fits) EXPECT_EQ(set.size(), 2U);
}

// 14^2 / 2 - 3 = 95 nat of its own; 95 - 0.4 * 95 = 57 is near. A share s of the square explains
// 98 s - 3: 60.7 and 50.9 nat.
TEST(ExchangeOfTwo, TriesWhatComesWithinAShareOfTheEvidence) {
  for (const auto& [share, tried] : {std::pair{0.65, true}, std::pair{0.55, false}}) {
    ToyLandscape toy({10.0, 14.0, 0.0});
    const Hypothesis x = toy.Add(Id::kUnbalance, {1.0, 0.0, 0.0});
    const Hypothesis y = toy.Add(Id::kShaftBow, {0.0, 1.0, 0.0});
    const Hypothesis beside =
        toy.Add(Id::kMisalignment, {0.0, std::sqrt(share), std::sqrt(1.0 - share)});
    CauseSelection found = toy.Found({x, y});
    ExchangeCauses(toy, ThoroughRules(), found);
    EXPECT_EQ(WasFitted(toy, {x.effect, beside.effect}), tried) << share;
  }
}

// 6^2 / 2 - 3 = 15 nat of its own: 15 nat less are near, though 0.4 of it are 6. 1.5 and -1.5 nat.
TEST(ExchangeOfTwo, TriesWhatComesWithinNearNatOfAWeakCause) {
  for (const auto& [share, tried] : {std::pair{0.25, true}, std::pair{0.08, false}}) {
    ToyLandscape toy({10.0, 6.0, 0.0});
    const Hypothesis x = toy.Add(Id::kUnbalance, {1.0, 0.0, 0.0});
    const Hypothesis y = toy.Add(Id::kShaftBow, {0.0, 1.0, 0.0});
    const Hypothesis beside =
        toy.Add(Id::kMisalignment, {0.0, std::sqrt(share), std::sqrt(1.0 - share)});
    CauseSelection found = toy.Found({x, y});
    ExchangeCauses(toy, ThoroughRules(), found);
    EXPECT_EQ(WasFitted(toy, {x.effect, beside.effect}), tried) << share;
  }
}

}  // namespace
}  // namespace levitas::diagnosis
