// The model bridges lost frames instead of starting anew at each.

#include <gtest/gtest.h>

#include "benchmark/accuracy/trial.hpp"
#include "diagnosis/inference/search.hpp"

namespace levitas::diagnosis {
namespace {

std::size_t Counting(const Trajectory& run) {
  std::size_t count = 0;
  for (const SamplePoint& moment : run.moments) count += moment.counts ? 1 : 0;
  return count;
}

class LostFrames : public ::testing::Test {
 protected:
  LostFrames() {
    accuracy::TrialPlan plan;
    plan.seed = 11;
    plan.bits_per_axis = 1275;
    plan.runup_s = 1.05;
    whole_ = accuracy::MakeTrial(bench_, plan).records.front();
  }

  [[nodiscard]] Trajectory Run(const Record& record) const {
    const Search search(view_, no_terms_);
    const auto gains = search.DesignGains({record}, kSlow);
    return RunModel(view_, record, gains.front(), {}, {}, 0.3);
  }

  accuracy::TestRig bench_ = accuracy::LoadTestRig("flexible_rotor", {"flexible_rotor"});
  RigView view_{bench_.rig.numbers, bench_.rig.plant};
  std::vector<Term> no_terms_;
  Record whole_;
};

TEST_F(LostFrames, OfWhichAFewAreMissingCostOnlyThemselves) {
  Record gappy = whole_;
  std::size_t lost = 0;
  for (std::size_t at = 5000; at < gappy.rows.size(); at += 500, ++lost) {
    gappy.rows.erase(gappy.rows.begin() + static_cast<std::ptrdiff_t>(at));
  }
  ASSERT_GT(lost, 5U);
  EXPECT_EQ(Counting(Run(gappy)), Counting(Run(whole_)) - lost);
}

TEST_F(LostFrames, ThatRepeatTheReadingBeforeDoNotCount) {
  Record stale = whole_;
  for (const std::size_t at : {std::size_t{6000}, std::size_t{7000}}) {
    stale.rows[at].sample.position_m = stale.rows[at - 1].sample.position_m;
  }
  EXPECT_EQ(Counting(Run(stale)), Counting(Run(whole_)) - 2U);
}

TEST_F(LostFrames, InALongGapMakeTheModelStartAnewAndSettle) {
  Record torn = whole_;
  torn.rows.erase(torn.rows.begin() + 6000, torn.rows.begin() + 6100);
  // Settling takes 0.3 s, 3000 rows of 0.1 ms, a second time.
  EXPECT_EQ(Counting(Run(torn)), Counting(Run(whole_)) - 100U - 3000U);
}

}  // namespace
}  // namespace levitas::diagnosis
