// When an answer is doubted: values that no healthy rig has, healthy records of another rig.

#include "diagnosis/report/input_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "diagnosis/report/build_report.hpp"
#include "diagnosis/report/named_values.hpp"
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
  for (std::size_t t = 0; t < s.terms.size(); ++t) {
    const Term& term = s.terms[t];
    if (term.effect_name() != "displacement_stiffness" || term.location.name != "nde_y") continue;
    s.answer.calibration.push_back({t, tolerances * term.tolerance, 0.1 * term.tolerance});
  }
  return s;
}

/// Records of the healthy rig have shown that axis to be `healthy_mean` tolerances off, and left a
/// fifth of its tolerance.
DiagnosisResult Learned(double healthy_mean, double found) {
  DiagnosisResult s = Calibrated(found);
  for (Term& term : s.terms) {
    s.file_tolerance.push_back(term.tolerance);
    if (term.effect_name() == "displacement_stiffness" && term.location.name == "nde_y") {
      term.healthy_mean = healthy_mean * term.tolerance;
      term.tolerance *= 0.2;
    }
  }
  return s;
}

TEST(DoubtTest, IsOfUnitsSignsAndTheFileWhereAValueIsFarOutOfItsTolerance) {
  // A tolerance of 0.03: -61 of them make -0.83 of a stiffness.
  const DiagnosisResult s = Calibrated(-61.0);
  EXPECT_THAT(BuildReport(s).input_warning,
              AllOf(HasSubstr("displacement_stiffness ratio of nde_y"), HasSubstr("-0.83"),
                    HasSubstr("61 tolerances off"), HasSubstr("units, signs or the rig file")));
  EXPECT_THAT(BuildReport(s).verdict_sentence, HasSubstr(BuildReport(s).input_warning));
  EXPECT_THAT(BuildReport(s).next_experiment, HasSubstr("check units and signs"));
  EXPECT_FALSE(BuildReport(s).needs_experiment) << "a scenario would not tell";
}

TEST(DoubtTest, IsNoneWithinWhatRigsDo) {
  EXPECT_THAT(BuildReport(Calibrated(7.0)).input_warning, IsEmpty());
  EXPECT_THAT(BuildReport(Calibrated(7.0)).next_experiment, Not(HasSubstr("check")));
}

TEST(DoubtTest, IsWhereTheNoiseIsLargerThanTheMotion) {
  DiagnosisResult s = NothingFound();
  s.validation.ceiling_percent = -5.0;  // known to a few per cent
  EXPECT_THAT(BuildReport(s).input_warning, IsEmpty());
  s.validation.ceiling_percent = -1e8;
  EXPECT_THAT(BuildReport(s).input_warning, HasSubstr("larger than the motion"));
}

TEST(HealthyTest, RecordsSayWhatTheyMoved) {
  EXPECT_THAT(BuildReport(Calibrated(2.0)).healthy_sentence, IsEmpty()) << "there are none";
  // 2 tolerances of 0.03
  EXPECT_THAT(BuildReport(Learned(2.0, 2.0)).healthy_sentence,
              AllOf(HasSubstr("displacement_stiffness ratio of nde_y from 1 to 1.06"),
                    HasSubstr("(2.0 tolerances)"), Not(HasSubstr("another rig"))));
}

TEST(HealthyTest, RecordsOfAnotherRigAreQuestioned) {
  // From 2 tolerances to 0.5: 7.5 times the fifth that was left.
  const DiagnosisResult s = Learned(2.0, 0.5);
  EXPECT_THAT(ChangedSince(CalibratedValues(s)), SizeIs(1));
  EXPECT_THAT(BuildReport(s).healthy_sentence, AllOf(HasSubstr("is 1.015, 7.5 of the tolerances"),
                                                     HasSubstr("another rig, or changed since?")));
  EXPECT_THAT(BuildReport(s).next_experiment, HasSubstr("healthy records are of this rig"));
  EXPECT_THAT(ChangedSince(CalibratedValues(Learned(2.0, 1.5))), IsEmpty());
}

}  // namespace
}  // namespace levitas::diagnosis
