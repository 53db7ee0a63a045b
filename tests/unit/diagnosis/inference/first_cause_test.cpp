// Selections that begin with another first cause where small ones follow the one that was found.

#include "diagnosis/inference/first_cause.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {
namespace {

/// Two causes that explain all, an imitation of both that explains most of it, and what is left of
/// the imitation as a cause of its own. The evidence of both sets is nearly the same, that of the
/// right one greater by less than a tenth of a nat.
struct Imitated {
  explicit Imitated(double size) : toy({10.0 * size, 6.0 * size, 0.0}) {
    toy.Add(role::kImitation, {0.8, 0.5, std::sqrt(1.0 - 0.89)});
    toy.Add(role::kOneMore[0], {0.0, 0.0, 1.0});
    toy.Add(role::kTrueCause, {1.0, 0.0, 0.0});
    toy.Add(role::kTrueSecond, {0.0, 1.0, 0.0});
    found = toy.Found({});
    AddCauses(toy, ThoroughRules(), found);
  }
  ToyLandscape toy;
  CauseSelection found;
};

using Effects = ToyLandscape::Effects;

TEST(AddCauses, AddsTheBestUntilNoneGainsEnough) {
  const Imitated one(1.3);
  EXPECT_EQ(ToyLandscape::EffectsOf(one.found.causes),
            (Effects{role::kImitation, role::kOneMore[0]}));
}

// Both are the same on the screen but for their Occam factor, and the second is better in fact.
TEST(AddCauses, TakesThePlaceThatIsBestOnTheNonlinearModel) {
  ToyLandscape toy({10.0, 0.1});
  toy.Add(role::kOnly, {1.0, 0.0}, "on the screen");
  toy.Add(role::kOnly, {0.999, 0.01}, "in fact");
  toy.from[toy.SolutionOf({toy.hypotheses()[1]}).theta[1]] = 1.0;
  CauseSelection found = toy.Found({});
  AddCauses(toy, ThoroughRules(), found);
  ASSERT_EQ(found.causes.size(), 1U);
  EXPECT_EQ(found.causes.front().place, "in fact");
}

TEST(AddCauses, AddsNoMoreThanThereMayBe) {
  Imitated one(1.3);
  SelectionRules rules = ThoroughRules();
  rules.most_causes = 1;
  CauseSelection found = one.toy.Found({});
  AddCauses(one.toy, rules, found);
  EXPECT_EQ(found.causes.size(), 1U);
}

// 9.7 nat behind 99.
TEST(ReconsiderFirstCause, FindsTheRightOneWhereASmallOneFollowsAnImitation) {
  Imitated one(1.3);
  ReconsiderFirstCause(one.toy, ThoroughRules(), one.found);
  EXPECT_EQ(ToyLandscape::EffectsOf(one.found.causes),
            (Effects{role::kTrueCause, role::kTrueSecond}));
  EXPECT_EQ(one.found.point.theta, one.toy.SolutionOf(one.found.causes).theta);
}

// 27 nat behind 239 are no small ones.
TEST(ReconsiderFirstCause, LeavesAFirstOneThatAStrongOneFollows) {
  Imitated one(2.0);
  ReconsiderFirstCause(one.toy, ThoroughRules(), one.found);
  EXPECT_EQ(ToyLandscape::EffectsOf(one.found.causes),
            (Effects{role::kImitation, role::kOneMore[0]}));
}

TEST(ReconsiderFirstCause, KeepsWhatWasFoundWhereNoFitFollows) {
  Imitated one(1.3);
  const auto& all = one.toy.hypotheses();
  for (unsigned set = 1; set < 1U << all.size(); ++set) {
    Effects effects;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if ((set >> i & 1U) != 0U) effects.insert(all[i].effect);
    }
    one.toy.refused.insert(effects);
  }
  const Point before = one.found.point;
  ReconsiderFirstCause(one.toy, ThoroughRules(), one.found);
  EXPECT_EQ(ToyLandscape::EffectsOf(one.found.causes),
            (Effects{role::kImitation, role::kOneMore[0]}));
  EXPECT_EQ(one.found.point, before);
}

TEST(ReconsiderFirstCause, LeavesACauseThatIsAlone) {
  ToyLandscape toy({10.0});
  CauseSelection found = toy.Found({toy.Add(role::kOnly, {1.0})});
  ReconsiderFirstCause(toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), Effects{role::kOnly});
  EXPECT_TRUE(toy.fits.empty());
}

}  // namespace
}  // namespace levitas::diagnosis
