// Exchange of causes for their nearest alternatives, on evidence that is known.

#include "diagnosis/inference/exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {
namespace {

/// A first cause, and a second one that was chosen while the first was still wrong; `true_second`
/// explains more beside the right first one.
struct Biased {
  ToyLandscape toy{{10.0, 0.0, 9.0}};
  Hypothesis first = toy.Add(role::kFirst, {1.0, 0.0, 0.0});
  Hypothesis second = toy.Add(role::kSecond, {0.0, 0.5, 1.0});
  Hypothesis true_second = toy.Add(role::kTrueSecond, {0.0, 0.0, 1.0});
};

TEST(ExchangeCauses, TakesTheAlternativeThatExplainsMore) {
  Biased b;
  CauseSelection found = b.toy.Found({b.first, b.second});
  ExchangeCauses(b.toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes),
            (ToyLandscape::Effects{role::kFirst, role::kTrueSecond}));
  EXPECT_NEAR(found.point.theta[b.true_second.terms.front()], 9.0, 1e-9);
}

TEST(ExchangeCauses, KeepsWhatIsBestAndTheShapesThatItHad) {
  Biased b;
  CauseSelection found = b.toy.Found({b.first, b.true_second});
  b.toy.shape[role::kSecond] = 1.0;  // of an alternative that loses all the same
  const auto before = found.point.shapes;
  ExchangeCauses(b.toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes),
            (ToyLandscape::Effects{role::kFirst, role::kTrueSecond}));
  EXPECT_EQ(found.point.shapes, before);
  EXPECT_EQ(std::count(b.toy.fits.begin(), b.toy.fits.end(),
                       ToyLandscape::Effects{role::kFirst, role::kSecond}),
            1)
      << "it was tried";
}

TEST(ExchangeCauses, JudgesAnAlternativeByItsBestShape) {
  Biased b;
  CauseSelection found = b.toy.Found({b.first, b.true_second});
  b.toy.shape[role::kSecond] = 30.0;
  ExchangeCauses(b.toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes),
            (ToyLandscape::Effects{role::kFirst, role::kSecond}));
  EXPECT_EQ(b.toy.PlaceAt(found.point, found.causes[1]), "at its shape");
  EXPECT_EQ(found.point.shapes[b.second.terms.front()], ToyLandscape::kBest);
}

// Two alternatives, each with a shape of its own: the second one loses and is taken back alone.
TEST(ExchangeCauses, KeepsTheShapeOfTheWinnerWhenTheNextOneLoses) {
  Biased b;
  const Hypothesis third = b.toy.Add(role::kThird, {0.0, 0.6, 1.0});
  CauseSelection found = b.toy.Found({b.first, b.true_second});
  b.toy.shape = {{role::kSecond, 30.0}, {role::kThird, 5.0}};
  ExchangeCauses(b.toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes),
            (ToyLandscape::Effects{role::kFirst, role::kSecond}));
  ASSERT_GE(b.toy.linearised.size(), 2U);
  EXPECT_EQ(b.toy.linearised[1][b.second.terms.front()], ToyLandscape::kBest) << "exchanged";
  EXPECT_NE(found.point.shapes[third.terms.front()], ToyLandscape::kBest);
}

TEST(ExchangeCauses, LeavesASingleCause) {
  Biased b;
  CauseSelection found = b.toy.Found({b.second});
  ExchangeCauses(b.toy, ThoroughRules(), found);
  EXPECT_EQ(found.causes.size(), 1U);
  EXPECT_TRUE(b.toy.fits.empty());
}

TEST(ExchangeCauses, LeavesCausesThatCannotBeFitted) {
  Biased b;
  b.toy.refused.insert({role::kFirst, role::kSecond});
  CauseSelection found = b.toy.Found({b.first, b.second});
  ExchangeCauses(b.toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes),
            (ToyLandscape::Effects{role::kFirst, role::kSecond}));
}

TEST(ExchangeCauses, DoesNotTryWhatIsFarBehind) {
  Biased b;
  b.toy.Add(role::kFarBehind, {0.0, 1.0, 0.05});
  CauseSelection found = b.toy.Found({b.first, b.true_second});
  ExchangeCauses(b.toy, ThoroughRules(), found);
  for (const ToyLandscape::Effects& fitted : b.toy.fits) {
    EXPECT_FALSE(fitted.contains(role::kFarBehind));
  }
}

}  // namespace
}  // namespace levitas::diagnosis
