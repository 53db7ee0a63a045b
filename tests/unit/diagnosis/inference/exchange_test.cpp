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
  Hypothesis first = toy.Add("first", {1.0, 0.0, 0.0});
  Hypothesis second = toy.Add("second", {0.0, 0.5, 1.0});
  Hypothesis true_second = toy.Add("true_second", {0.0, 0.0, 1.0});
};

TEST(ExchangeCauses, TakesTheAlternativeThatExplainsMore) {
  Biased b;
  CauseSelection found = b.toy.Found({b.first, b.second});
  ExchangeCauses(b.toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), (ToyLandscape::Effects{"first", "true_second"}));
  EXPECT_NEAR(found.theta[b.true_second.terms.front()], 9.0, 1e-9);
}

TEST(ExchangeCauses, KeepsWhatIsBestAndTheShapesThatItHad) {
  Biased b;
  CauseSelection found = b.toy.Found({b.first, b.true_second});
  b.toy.shape["second"] = 1.0;  // of an alternative that loses all the same
  const auto before = b.toy.Shapes();
  ExchangeCauses(b.toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), (ToyLandscape::Effects{"first", "true_second"}));
  EXPECT_EQ(b.toy.Shapes(), before);
  EXPECT_EQ(
      std::count(b.toy.fits.begin(), b.toy.fits.end(), ToyLandscape::Effects{"first", "second"}), 1)
      << "it was tried";
}

TEST(ExchangeCauses, JudgesAnAlternativeByItsBestShape) {
  Biased b;
  CauseSelection found = b.toy.Found({b.first, b.true_second});
  b.toy.shape["second"] = 30.0;
  ExchangeCauses(b.toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), (ToyLandscape::Effects{"first", "second"}));
  EXPECT_EQ(found.causes[1].place, "at its shape");
  EXPECT_EQ(b.toy.Shapes()[b.second.terms.front()], ToyLandscape::kBest);
}

// Two alternatives, each with a shape of its own: the second one loses and is taken back alone.
TEST(ExchangeCauses, KeepsTheShapeOfTheWinnerWhenTheNextOneLoses) {
  Biased b;
  const Hypothesis third = b.toy.Add("third", {0.0, 0.6, 1.0});
  CauseSelection found = b.toy.Found({b.first, b.true_second});
  b.toy.shape = {{"second", 30.0}, {"third", 5.0}};
  ExchangeCauses(b.toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), (ToyLandscape::Effects{"first", "second"}));
  ASSERT_GE(b.toy.linearised.size(), 2U);
  EXPECT_EQ(b.toy.linearised[1][b.second.terms.front()], ToyLandscape::kBest) << "exchanged";
  EXPECT_NE(b.toy.Shapes()[third.terms.front()], ToyLandscape::kBest);
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
  b.toy.refused.insert({"first", "second"});
  CauseSelection found = b.toy.Found({b.first, b.second});
  ExchangeCauses(b.toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), (ToyLandscape::Effects{"first", "second"}));
}

TEST(ExchangeCauses, DoesNotTryWhatIsFarBehind) {
  Biased b;
  b.toy.Add("far_behind", {0.0, 1.0, 0.05});
  CauseSelection found = b.toy.Found({b.first, b.true_second});
  ExchangeCauses(b.toy, ThoroughRules(), found);
  for (const ToyLandscape::Effects& fitted : b.toy.fits) {
    EXPECT_FALSE(fitted.contains("far_behind"));
  }
}

}  // namespace
}  // namespace levitas::diagnosis
