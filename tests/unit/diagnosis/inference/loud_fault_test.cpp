// When a loud fault takes the place of what was found, on readings that a filter hides.

#include "diagnosis/inference/loud_fault.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/diagnosis/toy_observed.hpp"
#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

using testing::IsEmpty;

// A line of three times the noise's power leaves twice the noise, and a filter foretells most of
// it. Of one that has as much power as the noise no filter could take more than a root of two.
TEST(IsLoud, IsALineOfFarMorePowerThanTheNoise) {
  constexpr std::size_t kSamples = 6'000;
  for (const auto& [power, loud] : {std::pair{0.0, false}, {1.0, false}, {3.0, true}}) {
    const Trajectory run =
        NoiseRun(20261130, kSamples, [power = power](std::size_t, SamplePoint& m) {
          m.innovation_m[1] +=
              static_cast<float>(Sine(kNoise * std::sqrt(2.0 * power), 91.0, m.time_s));
        });
    EXPECT_EQ(IsLoud({run}, TheRig().axes), loud) << power;
  }
}

/// Behind the filter nothing is decisive; without one the true cause is worth 197 nat. It costs
/// 500 nat less than anything else.
struct HiddenByTheFilter : ToyObserved {
  HiddenByTheFilter()
      : ToyObserved({1.0, 0.0}, {{role::kTrueCause, {1.0, 0.0}}, {role::kOther, {0.0, 1.0}}}) {
    loud = {{}};
    unfiltered_readings = {20.0, 0.0};
    number[{}] = kFarNumber;
    misfit = [](const EffectSet& set, double) {
      return set.contains(role::kTrueCause) ? 500.0 : 1000.0;
    };
  }

  /// True: taken.
  bool Take(CauseSelection& found, const SelectionRules& rules = ThoroughRules()) {
    LineariseAt(found.point);
    found.refitted.emplace_back();
    fits.clear();
    return TakeLoudFault(*this, rules, found);
  }
};

/// Both are as they were.
void ExpectStays(HiddenByTheFilter& toy, const SelectionRules& rules = ThoroughRules()) {
  CauseSelection found = toy.Calibrated();
  EXPECT_FALSE(toy.Take(found, rules));
  EXPECT_THAT(found.causes, IsEmpty());
  EXPECT_EQ(found.point, toy.Calibrated().point);
  EXPECT_FALSE(found.refitted.empty());
  EXPECT_EQ(toy.view().point, found.point);
}

TEST(TakeLoudFault, AsksTheFilesNumbersWithoutAFilter) {
  HiddenByTheFilter toy;
  CauseSelection found = toy.Calibrated();
  ASSERT_TRUE(toy.Take(found));
  EXPECT_EQ(Named(found), EffectSet{role::kTrueCause});
  ASSERT_EQ(toy.unfiltered_at.size(), 1U);
  EXPECT_EQ(toy.unfiltered_at[0], toy.FileNumbers()) << "not where calibration went";
  EXPECT_NEAR(found.point.theta[0], 1.0, 1e-9) << "as large as it is behind the filter";
  EXPECT_THAT(found.refitted, IsEmpty()) << "they were weighed by the filter that hid it";
}

TEST(TakeLoudFault, AsksNothingWhereNothingIsLoud) {
  HiddenByTheFilter toy;
  toy.loud.clear();
  ExpectStays(toy);
  EXPECT_THAT(toy.unfiltered_at, IsEmpty());
}

TEST(TakeLoudFault, AsksNothingWhereThereMayBeNoCause) {
  HiddenByTheFilter toy;
  SelectionRules rules = ThoroughRules();
  rules.most_causes = 0;
  ExpectStays(toy, rules);
  EXPECT_THAT(toy.unfiltered_at, IsEmpty());
}

TEST(TakeLoudFault, TakesWhatIsBetterByWhatSuspectsACause) {
  for (const auto& [gain, taken] : {std::pair{24.0, false}, std::pair{26.0, true}}) {
    HiddenByTheFilter toy;
    toy.misfit = [gain = gain](const EffectSet& set, double) { return set.empty() ? gain : 0.0; };
    if (taken) {
      CauseSelection found = toy.Calibrated();
      EXPECT_TRUE(toy.Take(found));
    } else {
      ExpectStays(toy);
    }
  }
}

TEST(TakeLoudFault, StaysWhereNoFitFollows) {
  HiddenByTheFilter toy;
  toy.refused = {{role::kTrueCause}};
  ExpectStays(toy);
}

TEST(TakeLoudFault, FitsNothingThatIsNotDecisive) {
  HiddenByTheFilter toy;
  toy.unfiltered_readings = {3.9, 0.0};  // 4.6 nat after its price
  ExpectStays(toy);
  EXPECT_THAT(toy.fits, IsEmpty());
}

TEST(TakeLoudFault, TakesTheBestFitOfTheThreeThatTheScreenPrefers) {
  ToyObserved toy({20.0, 19.0, 18.0, 17.0}, {{role::kFirst, {1.0, 0.0, 0.0, 0.0}},
                                             {role::kSecond, {0.0, 1.0, 0.0, 0.0}},
                                             {role::kThird, {0.0, 0.0, 1.0, 0.0}},
                                             {role::kFarBehind, {0.0, 0.0, 0.0, 1.0}}});
  toy.loud = {{}};
  toy.fitted = {{{role::kThird}, 0.0}, {{role::kFarBehind}, 100.0}};
  toy.misfit = [](const EffectSet& set, double) { return set.empty() ? 1000.0 : 0.0; };
  CauseSelection found = toy.Calibrated();
  EXPECT_TRUE(TakeLoudFault(toy, ThoroughRules(), found));
  EXPECT_EQ(Named(found), EffectSet{role::kThird});
}

}  // namespace
}  // namespace levitas::diagnosis
