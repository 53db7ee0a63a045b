// Evidence of causes in the records of a ball: kept, bettered, and asked for once more elsewhere.

#include "diagnosis/levitator/levitator_landscape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>

#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

const diagnosis::Hypothesis& CauseOf(effect::Id effect) {
  return *std::ranges::find(AllCauses(), effect, &diagnosis::Hypothesis::effect);
}

/// A coil whose inductance falls otherwise with the gap, driven at random.
class LevitatorLandscapeTest : public ::testing::Test {
 protected:
  LevitatorLandscapeTest() {
    truth_[kProfile] = 0.4;
    data_.emplace(rig_, std::vector<Series>{test::LivelySeries(rig_, truth_, 1500, 3)});
    landscape_.emplace(*data_, Progress{});
  }

  NominalRig rig_ = NominalOf(test::LevitatorFile());
  Theta truth_ = Zeros(1);
  std::optional<Misfit> data_;
  std::optional<LevitatorLandscape> landscape_;
  Causes right_{CauseOf(effect::Id::kInductanceProfile)};
};

TEST_F(LevitatorLandscapeTest, GainsFromTheCauseThatIsThereAndNotFromOthers) {
  const double right = landscape_->GainOf(right_.front(), {});
  EXPECT_GT(right, 100.0);
  EXPECT_NEAR(right, landscape_->FitOf(right_).evidence - landscape_->FitOf({}).evidence, 1e-9);
  EXPECT_LT(landscape_->GainOf(CauseOf(effect::Id::kCurrentSensorGain), right_), 10.0);
}

TEST_F(LevitatorLandscapeTest, ScreensEachEffectOnceAndNoneThatIsGiven) {
  const std::vector<diagnosis::Candidate> screened = landscape_->Screen(right_);
  std::set<effect::Id> effects;
  for (const diagnosis::Candidate& c : screened) {
    EXPECT_TRUE(effects.insert(c.effect).second) << c.place;
    EXPECT_EQ(AllCauses()[c.hypothesis].effect, c.effect);
    EXPECT_EQ(AllCauses()[c.hypothesis].place, c.place);
  }
  EXPECT_FALSE(effects.contains(effect::Id::kInductanceProfile));
  EXPECT_TRUE(std::is_sorted(screened.begin(), screened.end(),
                             [](const auto& a, const auto& b) { return a.score > b.score; }));
}

TEST_F(LevitatorLandscapeTest, KeepsTheBetterOfTwoFits) {
  const double one_step = landscape_->Fit(right_, landscape_->SolutionOf({}), 1).evidence;
  const double all = landscape_->Fit(right_, landscape_->SolutionOf({}), kAllSteps).evidence;
  EXPECT_GT(all, one_step);
  // A start far away, with one step: worse, so that what was kept is what is answered.
  diagnosis::Point far = landscape_->SolutionOf({});
  far.theta[kProfile] = -3.0;
  EXPECT_EQ(landscape_->Fit(right_, far, 1).evidence, all);
  EXPECT_EQ(landscape_->FitOf(right_).evidence, all);
}

// 0 from the same landscape, if a fit that was given up counted as made.
TEST_F(LevitatorLandscapeTest, AFitThatWasGivenUpIsFinishedWhenItIsAskedForAgain) {
  constexpr double kOutOfReach = 1e12;
  const double given_up = landscape_->Refit(right_, kOutOfReach).evidence;
  const double finished = landscape_->Refit(right_).evidence;
  const double at_once = LevitatorLandscape(*data_, {}).Refit(right_).evidence;
  EXPECT_GE(finished, given_up);
  EXPECT_NEAR(finished, at_once, 1.0);
  EXPECT_EQ(landscape_->Refit(right_).evidence, finished) << "kept where it stands";
}

TEST_F(LevitatorLandscapeTest, HasNeitherShapesNorStartsElsewhere) {
  EXPECT_FALSE(landscape_->HasShape(right_.front()));
  EXPECT_TRUE(landscape_->Probes().empty());
  EXPECT_EQ(landscape_->PlaceAt(landscape_->SolutionOf({}), right_.front()), "both coils");
}

}  // namespace
}  // namespace levitas::levitator
