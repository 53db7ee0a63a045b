// What a report says of a suspected cause, and of numbers outside their tolerance.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/report/build_report.hpp"
#include "diagnosis/report/report_text.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A report of a suspected cause.
DiagnosisReport Suspected(Doubt doubt, double probability) {
  DiagnosisResult found = Found(effect::Id::kEddyCurrent, "de_x");
  found.answer.verdict = Verdict::kSuspected;
  found.answer.doubt = doubt;
  found.answer.probability = probability;
  return BuildReport(found);
}

TEST(SuspectedTest, SaysWhyAndHowLikely) {
  const DiagnosisReport weak = Suspected(Doubt::kWeakEvidence, 0.72);
  EXPECT_THAT(weak.verdict_sentence, AllOf(HasSubstr("Suspected: eddy_current at de_x"),
                                           HasSubstr("72 %"), HasSubstr("not decisive")));
  EXPECT_EQ(weak.confidence, 0.72);
  EXPECT_NE(weak.next_experiment, kNoneNeeded);
  EXPECT_THAT(Suspected(Doubt::kValidationHarm, 0.01).verdict_sentence,
              HasSubstr("validation data refute it"));
  EXPECT_THAT(Suspected(Doubt::kUnconfirmed, 0.8).verdict_sentence,
              HasSubstr("validation data do not confirm it"));
  EXPECT_THAT(Suspected(Doubt::kMovedNumber, 0.98).verdict_sentence,
              HasSubstr("all but 2 % of healthy rigs"));
  EXPECT_THAT(Suspected(Doubt::kCutOff, 0.9).verdict_sentence, HasSubstr("a chain of causes"));
  EXPECT_THAT(Suspected(Doubt::kStopped, 0.99).verdict_sentence, HasSubstr("search was stopped"));
  EXPECT_THAT(Suspected(Doubt::kResidualIsLeft, 0.99).verdict_sentence,
              HasSubstr("a residual is left"));
}

TEST(SuspectedTest, IsNotSaidOfANamedCause) {
  const DiagnosisReport named = BuildReport(Found(effect::Id::kEddyCurrent, "de_x"));
  EXPECT_THAT(named.suspected_because, IsEmpty());
  EXPECT_THAT(named.verdict_sentence, Not(HasSubstr("Suspected")));
}

/// A search that ended before it had a cause; `nat` is the evidence of the best candidate.
DiagnosisReport StoppedWithout(double nat) {
  DiagnosisResult found = Found(effect::Id::kEddyCurrent, "de_x");
  found.answer.verdict = Verdict::kUnknown;
  found.answer.causes.clear();
  found.answer.stopped = true;
  found.answer.candidates.front().score = nat;
  return BuildReport(found);
}

TEST(StoppedTest, SaysThatNothingIsProvenAndWhatIsLikeliest) {
  const DiagnosisReport strong = StoppedWithout(40.0);
  EXPECT_THAT(strong.verdict_sentence,
              AllOf(HasSubstr("search was stopped"), HasSubstr("nothing ruled out"),
                    HasSubstr("eddy_current at de_x, 40 nat")));
  EXPECT_THAT(strong.verdict_sentence, Not(HasSubstr("A residual is left")));
  EXPECT_THAT(strong.headline, HasSubstr("Stopped"));
  EXPECT_THAT(strong.action, HasSubstr("Diagnose again"));
  EXPECT_THAT(strong.next_experiment, HasSubstr("same records to the end"));
  EXPECT_THAT(StoppedWithout(2.0).verdict_sentence, Not(HasSubstr("likeliest")));
}

TEST(OutsideToleranceTest, NamesEveryNumberBeyondThreeTolerances) {
  CalibratedValue far;
  far.effect = "sensor_offset";
  far.place = "de_x";
  far.key = "offset_um";
  far.from_file = 3.7;
  CalibratedValue near = far;
  near.from_file = 2.9;
  EXPECT_THAT(OutsideTolerance({near, far}),
              ElementsAre("sensor_offset offset_um of de_x (3.7 tolerances)"));
}

}  // namespace
}  // namespace levitas::diagnosis
