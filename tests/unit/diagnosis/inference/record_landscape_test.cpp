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

}  // namespace
}  // namespace levitas::diagnosis
