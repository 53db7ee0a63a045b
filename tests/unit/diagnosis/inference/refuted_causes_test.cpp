// Causes that lose on validation data go, the weakest first.

#include "diagnosis/inference/refuted_causes.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using Effects = ToyLandscape::Effects;

/// Three causes of 47, 29 and 15 nat.
struct Three {
  Three() : toy({6.0, 10.0, 8.0}) {
    weak = toy.Add(role::kWeak, {1.0, 0.0, 0.0});
    strong = toy.Add(role::kStrong, {0.0, 1.0, 0.0});
    second = toy.Add(role::kSecond, {0.0, 0.0, 1.0});
    found = toy.Found({weak, strong, second});
  }
  ToyLandscape toy;
  Hypothesis weak, strong, second;
  CauseSelection found;
};

FitGain Lost(const Refined& /*with*/, const Refined& /*without*/) { return {-1.0, 0.0}; }

TEST(DropRefuted, DropsTheWeakestAsLongAsItLosesAndKeepsAsManyAsItMust) {
  for (const auto& [kept, left] :
       {std::pair<std::size_t, Effects>{2, {role::kStrong, role::kSecond}},
        std::pair<std::size_t, Effects>{1, {role::kStrong}},
        std::pair<std::size_t, Effects>{0, {}}}) {
    Three three;
    DropRefuted(three.toy, ThoroughRules(), Lost, kept, three.found);
    EXPECT_EQ(ToyLandscape::EffectsOf(three.found.causes), left);
    EXPECT_EQ(three.found.point.theta, three.toy.SolutionOf(three.found.causes).theta);
  }
}

// What they gained beside a cause that is gone is no gain of theirs alone.
TEST(DropRefuted, ForgetsWhatWasFittedBesideADroppedCause) {
  for (const bool lost : {false, true}) {
    Three three;
    three.found.refitted = {{role::kOther, "here", 1.0, 0, true}};
    const auto gain = [lost](const Refined&, const Refined&) {
      return FitGain{lost ? -1.0 : 1.0, 0.0};
    };
    DropRefuted(three.toy, ThoroughRules(), gain, 2, three.found);
    EXPECT_EQ(three.found.refitted.empty(), lost);
  }
}

TEST(DropRefuted, StopsAtAWeakestThatIsWorthSomethingThere) {
  Three three;
  // By what the weakest moves: once it is gone, both fits have none of it.
  const std::size_t weak = three.weak.terms.front();
  const auto gain = [&](const Refined& with, const Refined& without) {
    return FitGain{with.point.theta[weak] > without.point.theta[weak] ? -1.0 : 1.0, 0.0};
  };
  DropRefuted(three.toy, ThoroughRules(), gain, 0, three.found);
  EXPECT_EQ(ToyLandscape::EffectsOf(three.found.causes), (Effects{role::kStrong, role::kSecond}));
}

}  // namespace
}  // namespace levitas::diagnosis
