// Words of the workshop: one row for every effect, complete, none twice.
#include "plant_sim/effect/workshop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::effect {
namespace {

TEST(Workshop, HasOneRowForEveryEffectOfTheCatalogueAndNoOther) {
  ASSERT_EQ(Workshop().size(), Catalogue().size());
  for (std::size_t i = 0; i < Catalogue().size(); ++i) {
    EXPECT_EQ(Workshop()[i].effect, Catalogue()[i].name);
    EXPECT_EQ(&WordsOf(Catalogue()[i].id), &Workshop()[i]);
  }
  EXPECT_EQ(WordsOfElectronics().size() + WordsOfMechanics().size() + WordsOfCoils().size(),
            Catalogue().size());
  EXPECT_EQ(FindWords("no_such_effect"), nullptr);
}

TEST(Workshop, SaysOfEveryEffectWhatItIsWhatItDoesAndWhatToCheck) {
  std::set<std::string_view> names;
  for (const Words& words : Workshop()) {
    EXPECT_TRUE(names.insert(words.name).second) << words.effect << ": " << words.name;
    EXPECT_TRUE(words.opposite.empty() || names.insert(words.opposite).second) << words.effect;
    EXPECT_EQ(words.name.find('_'), std::string_view::npos) << words.effect << ": an id";
    EXPECT_TRUE(words.does.ends_with('.')) << words.effect;
    EXPECT_TRUE(words.check.ends_with('.')) << words.effect;
    EXPECT_GT(words.check.size(), 20U) << words.effect;
  }
}

TEST(Workshop, TakesTheSizeFromAParameterThatTheEffectHas) {
  for (const Words& words : Workshop()) {
    const auto parameters = Find(words.effect)->parameters;
    EXPECT_TRUE(std::any_of(parameters.begin(), parameters.end(), [&](const Parameter& p) {
      return p.stem.starts_with(words.size);
    })) << words.effect;
    EXPECT_FALSE(words.size.empty()) << words.effect;
    // A factor counts from 1, and only a factor is off by per cents.
    if (words.form == SizeForm::kOff) {
      EXPECT_EQ(parameters[0].neutral, 1.0) << words.effect;
    }
    if (words.yardstick == Yardstick::kLoopGain) {
      EXPECT_EQ(words.form, SizeForm::kOff) << words.effect;
    }
  }
}

TEST(Workshop, StopsTheMachineAtOnceForWhatGrowsAndOnlyForThat) {
  for (const Words& words : Workshop()) {
    EXPECT_EQ(words.stop == Stop::kAtOnce, words.yardstick == Yardstick::kGrows) << words.effect;
  }
  EXPECT_EQ(WordsOf(Id::kBreathingCrack).stop, Stop::kAtOnce);
  EXPECT_EQ(WordsOf(Id::kTouchdownRub).stop, Stop::kAtOnce);
}

TEST(Workshop, BearsTheGainsThatALoopAtTheEndOfZoneABears) {
  // |S| = 3: the critical point is no nearer than 1/3 to the curve, which crosses the real axis
  // between -2/3 and -4/3 nowhere.
  EXPECT_NEAR(kMostGain, 1.0 / (2.0 / 3.0), 1e-12);
  EXPECT_NEAR(kLeastGain, 1.0 / (4.0 / 3.0), 1e-12);
}

}  // namespace
}  // namespace levitas::effect
