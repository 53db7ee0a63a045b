// Every effect in the place of every cause.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/inference/alternatives.hpp"
#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using Effects = ToyLandscape::Effects;

const Candidate& Of(const std::vector<Candidate>& candidates, effect::Id effect) {
  return *std::find_if(candidates.begin(), candidates.end(),
                       [&](const Candidate& c) { return c.effect == effect; });
}

/// 47 and 15 nat, and an alternative that does nine tenths of what the strong one does.
struct TwoBesideOne {
  TwoBesideOne() : toy({6.0, 10.0, 0.0}) {
    weak = toy.Add(role::kWeak, {1.0, 0.0, 0.0});
    strong = toy.Add(role::kStrong, {0.0, 1.0, 0.0});
    toy.Add(role::kAlternative, {0.0, std::sqrt(0.9), std::sqrt(0.1)});
    found = toy.Found({weak, strong});
  }
  ToyLandscape toy;
  Hypothesis weak, strong;
  CauseSelection found;
};

TEST(RankInPlaceOfEach, HasOneListForEveryCauseTheWeightiestFirst) {
  TwoBesideOne two;
  const auto lists = RankInPlaceOfEach(two.toy, ThoroughRules(), two.found);
  ASSERT_EQ(lists.size(), 2U);
  ASSERT_EQ(two.found.causes.size(), 2U);
  EXPECT_EQ(two.found.causes[0].effect, role::kStrong);
  EXPECT_EQ(two.found.causes[1].effect, role::kWeak);
  EXPECT_NEAR(Of(lists[0], role::kStrong).score, 47.0, 1e-9);
  EXPECT_NEAR(Of(lists[0], role::kAlternative).score, 42.0, 1e-9);
  EXPECT_TRUE(Of(lists[0], role::kAlternative).refitted);
  EXPECT_NEAR(Of(lists[1], role::kWeak).score, 15.0, 1e-9);
  EXPECT_NEAR(Of(lists[1], role::kAlternative).score, -3.0, 1e-9) << "beside the strong one";
}

TEST(RankInPlaceOfEach, PutsABetterAlternativeInThePlaceOfItsCause) {
  TwoBesideOne two;
  two.toy.fitted[{role::kWeak, role::kAlternative}] = 60.0;
  const auto lists = RankInPlaceOfEach(two.toy, ThoroughRules(), two.found);
  EXPECT_EQ(ToyLandscape::EffectsOf(two.found.causes), (Effects{role::kWeak, role::kAlternative}));
  EXPECT_EQ(lists.size(), 2U);
}

TEST(RankInPlaceOfEach, WithoutACauseHasOneListOfWhatEachWouldAdd) {
  TwoBesideOne two;
  CauseSelection none = two.toy.Found({});
  const auto lists = RankInPlaceOfEach(two.toy, ThoroughRules(), none);
  ASSERT_EQ(lists.size(), 1U);
  EXPECT_EQ(lists.front().size(), 3U);
  EXPECT_EQ(lists.front().front().effect, role::kStrong);
}

// 2 nat on the screen where the leader has 47: no rule of nearness would fit it.
TEST(RefitAlternatives, FitsWhatIsAlikeHoweverFarBehindTheScreenSeesIt) {
  for (const bool is_alike : {false, true}) {
    ToyLandscape toy({10.0, 0.0});
    const Hypothesis leader = toy.Add(role::kLeader, {1.0, 0.0});
    toy.Add(role::kFarBehind, {std::sqrt(0.1), std::sqrt(0.9)});
    SelectionRules rules = ThoroughRules();
    if (is_alike) {
      rules.alike = [](effect::Id one, effect::Id other) {
        return one == role::kLeader && other == role::kFarBehind;
      };
    }
    CauseSelection found = toy.Found({leader});
    RankCandidates(toy, rules, found);
    RefitAlternatives(toy, rules, found);
    EXPECT_EQ(WasFitted(toy, {role::kFarBehind}), is_alike);
  }
}

// The same where the screen decides nothing.
TEST(RefitAlternatives, FitsWhatIsFarBehindWhereTheScreenDoesNotDecide) {
  for (const bool decides : {true, false}) {
    ToyLandscape toy({10.0, 0.0});
    const Hypothesis leader = toy.Add(role::kLeader, {1.0, 0.0});
    toy.Add(role::kFarBehind, {0.0, 1.0});
    SelectionRules rules = ThoroughRules();
    rules.screen_decides = decides;
    CauseSelection found = toy.Found({leader});
    RankCandidates(toy, rules, found);
    RefitAlternatives(toy, rules, found);
    EXPECT_EQ(WasFitted(toy, {role::kFarBehind}), !decides);
  }
}

/// What no straight line leads to is not on the screen.
class WithoutALine : public ToyLandscape {
 public:
  using ToyLandscape::ToyLandscape;
  effect::Id unseen{};
  [[nodiscard]] std::vector<Candidate> Screen(const Causes& given) const override {
    std::vector<Candidate> screened = ToyLandscape::Screen(given);
    std::erase_if(screened, [this](const Candidate& c) { return c.effect == unseen; });
    return screened;
  }
};

TEST(RankInPlaceOfEach, HasTheCauseInItsOwnPlaceThoughTheScreenDoesNotSeeIt) {
  WithoutALine toy({10.0, 0.0});
  const Hypothesis leader = toy.Add(role::kLeader, {1.0, 0.0});
  toy.Add(role::kAlternative, {std::sqrt(0.9), std::sqrt(0.1)});
  toy.unseen = role::kLeader;
  CauseSelection found = toy.Found({leader});
  const auto lists = RankInPlaceOfEach(toy, ThoroughRules(), found);
  ASSERT_EQ(lists.size(), 1U);
  ASSERT_EQ(lists.front().size(), 2U);
  EXPECT_EQ(lists.front().front().effect, role::kLeader);
  EXPECT_NEAR(lists.front().front().score, 47.0, 1e-9);
  EXPECT_EQ(lists.front().front().hypothesis, 0U);
  EXPECT_TRUE(Of(lists.front(), role::kAlternative).refitted);
}

}  // namespace
}  // namespace levitas::diagnosis
