// Causes at rest against validation data that show them, deny them, or cannot tell.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "diagnosis/inference/validation.hpp"
#include "tests/unit/diagnosis/rest_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

constexpr double kFound = 4.0 * kOffsetTolerance;

/// Fitted to a record in which the probe of de_x reads `kFound` beside its file.
struct OffsetFound {
  RestLandscape& rest = FourTolerances();
  CauseSelection found = rest.Calibrated();

  OffsetFound() {
    found.causes = {rest.Of(Id::kSensorOffset, "de_x")};
    found.candidates = {rest.CandidateOf(Id::kSensorOffset, "de_x", 5.0),
                        rest.CandidateOf(Id::kMainsPickup, kHumPlace, 4.0)};
  }
  void Judge(const std::vector<Record>& validation) {
    JudgeOnValidation(rest.landscape, validation, Judging{}, found);
  }
};

TEST(JudgeOnValidation, WithoutSuchDataDoubtsNothing) {
  OffsetFound of;
  of.Judge({});
  EXPECT_EQ(of.found.doubt, Doubt::kNothing);
  EXPECT_FALSE(of.found.candidates.front().validation_nat.has_value());
}

TEST(JudgeOnValidation, KeepsACauseThatTheDataShowAgain) {
  OffsetFound of;
  of.Judge({RestRecord(0.0, kFound)});
  ASSERT_EQ(of.found.causes.size(), 1U);
  EXPECT_EQ(of.found.doubt, Doubt::kNothing);
  ASSERT_TRUE(of.found.candidates.front().validation_nat.has_value());
  EXPECT_GT(*of.found.candidates.front().validation_nat, 0.0);
  EXPECT_FALSE(of.found.candidates.back().validation_nat.has_value()) << "was no contender";
}

// The fitted record knows the offset to a hundredth of a tolerance: it may not adapt to none.
TEST(JudgeOnValidation, SuspectsACauseThatTheDataDeny) {
  OffsetFound of;
  of.Judge({RestRecord(0.0, 0.0)});
  EXPECT_EQ(of.found.doubt, Doubt::kValidationHarm);
  EXPECT_LT(of.found.probability, 0.5);
  EXPECT_EQ(of.found.causes.size(), 1U) << "suspected, not dropped";
}

// Fitted as a hum it leaves the offset to the calibrated numbers.
TEST(JudgeOnValidation, LeadsWithTheContenderThatForetellsTheDataBetter) {
  OffsetFound of;
  CauseSet hum;
  hum.causes = {of.rest.Of(Id::kMainsPickup, kHumPlace)};
  hum.fit.point = of.found.calibrated;
  hum.fit.point.theta[of.rest.TermOf(Id::kSensorOffset, "de_x")] = 0.0;
  of.found.contenders = {hum};
  of.Judge({RestRecord(0.0, 0.0)});
  ASSERT_EQ(of.found.causes.size(), 1U);
  EXPECT_EQ(of.found.causes.front().place, kHumPlace);
  EXPECT_EQ(of.found.candidates.front().place, kHumPlace);
  EXPECT_EQ(of.found.point, hum.fit.point);
}

// At rest an unbalance moves nothing: worth nothing, and no reason to doubt it.
TEST(JudgeOnValidation, DoesNotDoubtWhatTheDataCannotShow) {
  OffsetFound of;
  of.found.causes = {of.rest.Of(Id::kUnbalance, "z 129.9 mm")};
  of.found.candidates = {of.rest.CandidateOf(Id::kUnbalance, "z 129.9 mm", 5.0)};
  of.Judge({RestRecord(0.0, kFound)});
  EXPECT_EQ(of.found.doubt, Doubt::kNothing);
  EXPECT_EQ(of.found.causes.size(), 1U);
  ASSERT_TRUE(of.found.candidates.front().validation_nat.has_value());
  // Less than a thousandth of what decides.
  EXPECT_NEAR(*of.found.candidates.front().validation_nat, 0.0, 0.005) << of.found.probability;
}

}  // namespace
}  // namespace levitas::diagnosis
