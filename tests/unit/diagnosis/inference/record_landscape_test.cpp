// What a record's landscape calls members of families, whose shapes are those of a point.

#include "diagnosis/inference/record_landscape.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/diagnosis/rest_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

/// The calibrated point, but for the slew limit of 4000 A/s, which is another one.
Point WithOtherSlew(const RestLandscape& rest) {
  Point point = rest.Calibrated().point;
  point.shapes[rest.TermOf(Id::kAmplifierSlew, "4000 A/s")] = {2345.0};
  return point;
}

TEST(RecordLandscape, CallsAMemberOfAFamilyAfterItsShape) {
  const RestLandscape& rest = NothingWrong();
  const Hypothesis& slew = rest.Of(Id::kAmplifierSlew, "4000 A/s");
  EXPECT_EQ(rest.landscape.PlaceAt(rest.Calibrated().point, slew), "4000 A/s");
  EXPECT_EQ(rest.landscape.PlaceAt(WithOtherSlew(rest), slew), "2345 A/s");
  EXPECT_EQ(slew.place, "4000 A/s") << "the hypothesis keeps its name";
}

TEST(RecordLandscape, CallsWhatIsNoMemberAsItsHypothesisDoes) {
  const RestLandscape& rest = NothingWrong();
  const Hypothesis& hum = rest.Of(Id::kMainsPickup, "50 Hz, all axes");
  EXPECT_EQ(rest.landscape.PlaceAt(WithOtherSlew(rest), hum), hum.place);
}

TEST(RecordLandscape, ScreensAndSolvesWithTheShapesWhereItIsLinearised) {
  RestLandscape& rest = NothingWrong();
  const Point other = WithOtherSlew(rest);
  rest.landscape.LineariseAt(other);
  const auto& all = rest.landscape.hypotheses();
  for (const Candidate& candidate : rest.landscape.Screen({})) {
    EXPECT_EQ(candidate.place, rest.landscape.PlaceAt(other, all[candidate.hypothesis]));
  }
  EXPECT_EQ(rest.landscape.SolutionOf({}).shapes, other.shapes);
  const Refined fit = rest.landscape.Fit({}, other, 1);
  ASSERT_TRUE(fit.ok);
  EXPECT_EQ(fit.point.shapes, other.shapes);
}

// Where calibration went, the file is not.
TEST(RecordLandscape, KnowsTheFilesNumbersBesideTheCalibratedOnes) {
  const RestLandscape& rest = FourTolerances();
  const std::size_t offset = rest.TermOf(Id::kSensorOffset, "de_x");
  EXPECT_EQ(rest.landscape.FileNumbers().theta[offset], 0.0);
  EXPECT_EQ(rest.landscape.view().point.theta[offset], 4.0 * kOffsetTolerance);
}

// Noise of 1 um on every probe, which the slow observer follows by some per cent at most.
TEST(RecordLandscape, FindsNothingLoudNorLostInNoise) {
  const RestLandscape& rest = NothingWrong();
  const Point& at = rest.landscape.view().point;
  EXPECT_FALSE(rest.landscape.IsLoudAt(at));
  EXPECT_FALSE(rest.landscape.ModelDivergesAt(at));
  const Whitener plain = rest.landscape.PlainFilterOf(*rest.landscape.RunsAt(at));
  ASSERT_EQ(plain.filter.size(), rest.landscape.rig().axes);
  for (const auto& axis : plain.filter) EXPECT_NEAR(1.0 / axis.front(), kHumNoise, 0.1 * kHumNoise);
}

}  // namespace
}  // namespace levitas::diagnosis
