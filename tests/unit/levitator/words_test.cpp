// Words of the workshop: there for every parameter of a ball, its own about parameters that exist.

#include "diagnosis/levitator/words.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "diagnosis/levitator/parameters.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::levitator {
namespace {

TEST(OwnWords, AreSaidOnceOfEffectsOfTheTableWithTheStemOfAParameterAsSize) {
  std::set<std::string_view> said;
  for (const effect::Words& words : OwnWords()) {
    EXPECT_TRUE(said.insert(words.effect).second) << words.effect << " twice";
    EXPECT_TRUE(std::ranges::any_of(Table(), [&](const Row& row) {
      return effect::At(row.effect).name == words.effect && row.name.starts_with(words.size);
    })) << words.effect;
  }
}

// A factor is above or below 1, and people hear which; all else has one name.
TEST(OwnWords, HaveTwoNamesWhereTheSizeIsAFactorAndSentencesForWhatToDo) {
  for (const effect::Words& words : OwnWords()) {
    EXPECT_EQ(words.opposite.empty(), words.form != effect::SizeForm::kOff) << words.effect;
    EXPECT_NE(words.name, words.opposite) << words.effect;
    EXPECT_TRUE(words.does.ends_with('.')) << words.effect;
    EXPECT_TRUE(words.check.ends_with('.')) << words.effect;
  }
}

}  // namespace
}  // namespace levitas::levitator
