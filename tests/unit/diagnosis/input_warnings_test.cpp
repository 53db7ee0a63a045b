// When an answer is doubted: values that no healthy rig has, healthy records of another rig.

#include "diagnosis/report/input_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "diagnosis/report/words.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// Stiffness of one axis calibrated that many tolerances off.
DiagnosisResult Calibrated(double tolerances) {
  DiagnosisResult s = NothingFound();
  for (const Term& term : s.terms) {
    if (term.effect != "displacement_stiffness" || term.place != "nde_y") continue;
    s.answer.calibration.push_back({term.effect, term.place, term.parameter, term.unit,
                                    tolerances * term.tolerance, 0.1 * term.tolerance});
  }
  return s;
}

/// Records of the healthy rig have shown that axis to be `healthy_mean` tolerances off, and left a
/// fifth of its tolerance.
DiagnosisResult Learned(double healthy_mean, double found) {
  DiagnosisResult s = Calibrated(found);
  for (Term& term : s.terms) {
    s.file_tolerance.push_back(term.tolerance);
    if (term.effect == "displacement_stiffness" && term.place == "nde_y") {
      term.healthy_mean = healthy_mean * term.tolerance;
      term.tolerance *= 0.2;
    }
  }
  return s;
}

TEST(DoubtTest, IsOfUnitsSignsAndTheFileWhereAValueIsFarOutOfItsTolerance) {
  // A tolerance of 0.03: -61 of them make -0.83 of a stiffness.
  const DiagnosisResult s = Calibrated(-61.0);
  EXPECT_THAT(DoubtSentence(s),
              AllOf(HasSubstr("displacement_stiffness ratio of nde_y"), HasSubstr("-0.83"),
                    HasSubstr("61 tolerances off"), HasSubstr("units, signs or the rig file")));
  EXPECT_THAT(VerdictSentence(s), HasSubstr(DoubtSentence(s)));
  EXPECT_THAT(NextExperiment(s), HasSubstr("check units and signs"));
  EXPECT_FALSE(NeedsExperiment(s)) << "a scenario would not tell";
}

TEST(DoubtTest, IsNoneWithinWhatRigsDo) {
  EXPECT_THAT(DoubtSentence(Calibrated(7.0)), IsEmpty());
  EXPECT_THAT(NextExperiment(Calibrated(7.0)), Not(HasSubstr("check")));
}

TEST(DoubtTest, IsWhereTheNoiseIsLargerThanTheMotion) {
  DiagnosisResult s = NothingFound();
  s.validation.ceiling_percent = -5.0;  // known to a few per cent
  EXPECT_THAT(DoubtSentence(s), IsEmpty());
  s.validation.ceiling_percent = -1e8;
  EXPECT_THAT(DoubtSentence(s), HasSubstr("larger than the motion"));
}

TEST(HealthyTest, RecordsSayWhatTheyMoved) {
  EXPECT_THAT(HealthySentence(Calibrated(2.0)), IsEmpty()) << "there are none";
  // 2 tolerances of 0.03
  EXPECT_THAT(HealthySentence(Learned(2.0, 2.0)),
              AllOf(HasSubstr("displacement_stiffness ratio of nde_y from 1 to 1.06"),
                    HasSubstr("(2.0 tolerances)"), Not(HasSubstr("another rig"))));
}

TEST(HealthyTest, RecordsOfAnotherRigAreQuestioned) {
  // From 2 tolerances to 0.5: 7.5 times the fifth that was left.
  const DiagnosisResult s = Learned(2.0, 0.5);
  EXPECT_THAT(ChangedSince(s), SizeIs(1));
  EXPECT_THAT(HealthySentence(s), AllOf(HasSubstr("is 1.015, 7.5 of the tolerances"),
                                        HasSubstr("another rig, or changed since?")));
  EXPECT_THAT(NextExperiment(s), HasSubstr("healthy records are of this rig"));
  EXPECT_THAT(ChangedSince(Learned(2.0, 1.5)), IsEmpty());
}

}  // namespace
}  // namespace levitas::diagnosis
