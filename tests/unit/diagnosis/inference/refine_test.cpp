// Joint fits of nuisances and causes to records at rest whose numbers are known.

#include "diagnosis/inference/refine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "diagnosis/inference/calibrate.hpp"
#include "tests/unit/diagnosis/rest_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

constexpr double kReadsBeside = 2.5 * kOffsetTolerance;

/// A probe of de_x that reads beside its file, seen from the file's numbers.
class Refine : public testing::Test {
 protected:
  [[nodiscard]] const RestLandscape& rest() const {
    static RestLandscape beside(0.0, kReadsBeside);
    return beside.Again();
  }
  [[nodiscard]] std::size_t offset() const { return rest().TermOf(Id::kSensorOffset, "de_x"); }
  [[nodiscard]] Refiner MakeRefiner() const {
    const RecordLandscape& of = rest().landscape;
    return {of.search(), of.terms(), of.records(), of.gains(), of.rig().axes};
  }
  [[nodiscard]] Point File() const { return rest().landscape.search().HealthyPoint(); }
};

TEST_F(Refine, ApproachFindsAnOffsetFromTheFile) {
  const Refined fit = MakeRefiner().Approach(File(), kWhiteningOrder, 8);
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.point.theta[offset()], kReadsBeside, 0.05 * kOffsetTolerance);
}

// Two and a half tolerances away, one step of a linear model ends where several do.
TEST_F(Refine, ApproachEndsAfterItsFirstPassOnceASearchIsToEnd) {
  const RecordLandscape& of = rest().landscape;
  Search stopping(of.rig(), of.terms());
  int asked = 0;
  stopping.StopWhen([&asked] { return ++asked > 0; });
  const Refiner refiner(stopping, of.terms(), of.records(), of.gains(), of.rig().axes);
  const Refined fit = refiner.Approach(File(), kWhiteningOrder, 8);
  ASSERT_TRUE(fit.ok);
  EXPECT_EQ(fit.point, File()) << "the step from there was not run";
  EXPECT_EQ(asked, 1);
  EXPECT_GT(fit.problem.jtj.size(), 0) << "linearised, so that causes can be weighed";
}

TEST_F(Refine, MisfitIsLessWhereTheOffsetIs) {
  const Refiner refiner = MakeRefiner();
  Point there = File();
  there.theta[offset()] = kReadsBeside;
  EXPECT_LT(refiner.Misfit(there, kWhiteningOrder), refiner.Misfit(File(), kWhiteningOrder));
}

TEST_F(Refine, ApproachSaysThatItCannotBeginWhereTheModelIsNoNumber) {
  Point nowhere = File();
  nowhere.theta[offset()] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(MakeRefiner().Approach(nowhere, kWhiteningOrder, 3).ok);
}

// A hum that is not there costs its Occam factor, and stays at nothing.
TEST_F(Refine, FitOfACauseThatIsNotThereGainsNothing) {
  const RecordLandscape& of = rest().landscape;
  const std::vector<Hypothesis> hum{rest().Of(Id::kMainsPickup, kHumPlace)};
  const Point start = of.view().point;
  const Refined without = of.Fit({}, start, 3);
  const Refined with = of.Fit(hum, start, 3);
  ASSERT_TRUE(without.ok);
  ASSERT_TRUE(with.ok);
  EXPECT_LT(with.evidence, without.evidence);
}

TEST_F(Refine, FitFromTheFileReachesTheSamePointAsFromTheOffset) {
  const RecordLandscape& of = rest().landscape;
  const Refined near = of.Fit({}, of.view().point, 5);
  const Refined far = of.Fit({}, File(), 5);
  ASSERT_TRUE(near.ok);
  ASSERT_TRUE(far.ok);
  EXPECT_NEAR(far.point.theta[offset()], near.point.theta[offset()], 0.02 * kOffsetTolerance);
  EXPECT_NEAR(far.evidence, near.evidence, 1.0);
}

// With the file's numbers narrowed by the healthy record itself, its own offset is the new centre.
TEST_F(Refine, HealthyRecordsNarrowTolerancesAboutThemselves) {
  const RecordLandscape& of = rest().landscape;
  const std::vector<Term> narrowed =
      LearnFromHealthy(of.rig(), of.records(), Judging{}, of.terms());
  ASSERT_EQ(narrowed.size(), of.terms().size());
  const Term& offset_term = narrowed[offset()];
  EXPECT_NEAR(offset_term.healthy_mean, kReadsBeside, 0.05 * kOffsetTolerance);
  EXPECT_GE(offset_term.tolerance, kDaily * kOffsetTolerance) << "what changes from day to day";
  EXPECT_LT(offset_term.tolerance, 0.3 * kOffsetTolerance);
  for (std::size_t i = 0; i < narrowed.size(); ++i) {
    EXPECT_LE(narrowed[i].tolerance, of.terms()[i].tolerance);
  }
}

}  // namespace
}  // namespace levitas::diagnosis
