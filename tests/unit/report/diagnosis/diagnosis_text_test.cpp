#include "report/diagnosis/diagnosis_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "diagnosis/report/report_text.hpp"
#include "tests/unit/report/diagnosis/reports.hpp"

namespace levitas::report {
namespace {

using diagnosis::DiagnosisReport;
using diagnosis::test::OneCause;
using diagnosis::test::ParameterAt;
using testing::HasSubstr;
using testing::Not;

std::vector<SharedParameter> Shared(const DiagnosisReport& report) {
  return SharedParameters(report, diagnosis::SentencesOf(report));
}

TEST(SharedParameters, ThatAreTheSameAtSeveralPlacesStandOnce) {
  DiagnosisReport report = OneCause();
  report.rig_channels = {"de_x", "de_y", "nde_x"};
  report.parameters = {ParameterAt("de_x"), ParameterAt("de_y"), ParameterAt("nde_x", 200.0)};
  const auto shared = Shared(report);
  ASSERT_EQ(shared.size(), 2U);
  EXPECT_EQ(shared[0].places, "de_x, de_y");
  EXPECT_EQ(shared[1].places, "nde_x");
  EXPECT_EQ(shared[1].parameter.value, 200.0);
}

TEST(SharedParameters, OfEveryChannelOfTheRigAreOfAllAxes) {
  DiagnosisReport report = OneCause();
  report.parameters = {ParameterAt("de_x"), ParameterAt("de_y")};
  EXPECT_EQ(Shared(report)[0].places, "all axes");
  // A rig of one channel has a place all the same.
  report.rig_channels = {"de_x"};
  report.parameters = {ParameterAt("de_x")};
  EXPECT_EQ(Shared(report)[0].places, "de_x");
}

TEST(SharedParameters, WithOtherIntervalsAreNotTheSame) {
  DiagnosisReport report = OneCause();
  report.parameters = {ParameterAt("de_x"), ParameterAt("de_y")};
  report.parameters[1].high += 1.0;
  EXPECT_EQ(Shared(report).size(), 2U);
}

TEST(AtPhase, GivesDegreesWhereThereIsAPhaseAndTheValueAloneElsewhere) {
  EXPECT_EQ(AtPhase(18.5, std::numbers::pi / 2.0), "18.5 at 90.0 deg");
  EXPECT_EQ(AtPhase(18.5, std::nullopt), "18.5");
}

TEST(FitRemarks, SayWhyAFitLiesAboveItsCeilingOnlyWhereOneDoes) {
  DiagnosisReport report = OneCause();
  EXPECT_EQ(FitRemarks(report), "");
  report.validation.extended_percent = report.validation.ceiling_percent + 0.1;
  EXPECT_THAT(FitRemarks(report), HasSubstr("at the ceiling"));
  // What rounds to the same two digits is not above.
  report.validation.extended_percent = report.validation.ceiling_percent + 0.001;
  EXPECT_EQ(FitRemarks(report), "");
}

TEST(FitRemarks, SayWhyCalibrationFitsLessOnlyWhereItDoes) {
  DiagnosisReport report = OneCause();
  report.fitted.calibrated_percent = report.fitted.nominal_percent - 0.1;
  EXPECT_THAT(FitRemarks(report), HasSubstr("is no loss"));
  report.fitted.calibrated_percent = report.fitted.nominal_percent - 0.001;
  EXPECT_EQ(FitRemarks(report), "");
  // On data that were not fitted it is one.
  report.validation.calibrated_percent = report.validation.nominal_percent - 0.1;
  EXPECT_EQ(FitRemarks(report), "");
}

TEST(FurtherRecords, SayWhatTheyAreNotNeededFor) {
  DiagnosisReport report = OneCause();
  EXPECT_EQ(FurtherRecords(report), "record a run-up");
  report.next_experiment = diagnosis::kNoneNeeded;
  EXPECT_EQ(FurtherRecords(report), "none needed to name the cause");
  report.causes.clear();
  EXPECT_EQ(FurtherRecords(report), "none needed");
}

TEST(HealthyProposalText, NamesTheSessionThatWasFound) {
  DiagnosisReport report = OneCause();
  EXPECT_EQ(HealthyProposalText(report), "");
  report.healthy_proposal = "Compare.";
  EXPECT_EQ(HealthyProposalText(report), "Compare.");
  report.healthy_record = "/data/good.lcm";
  EXPECT_THAT(HealthyProposalText(report), HasSubstr("--healthy /data/good.lcm"));
}

class Printed : public testing::Test {
 protected:
  static std::string Of(const DiagnosisReport& report, bool complete) {
    testing::internal::CaptureStdout();
    PrintDiagnosis(report, complete);
    std::fflush(stdout);
    return testing::internal::GetCapturedStdout();
  }
};

TEST_F(Printed, BeginsWithTheVerdictAndEndsWithWhatToRecordNext) {
  const std::string text = Of(OneCause(), false);
  EXPECT_TRUE(text.starts_with("Eddy currents slow the magnet at de_x [eddy_current].\n")) << text;
  EXPECT_THAT(text, HasSubstr("What it does: Force falls off.\nAction: Check the yoke.\n"));
  EXPECT_THAT(text, HasSubstr("In detail: Eddy currents on de_x.\n"));
  EXPECT_TRUE(text.ends_with("Further records: record a run-up\n")) << text;
  EXPECT_THAT(text, Not(HasSubstr("Next:")));
}

TEST_F(Printed, ShowsTheParametersAsInARigFile) {
  EXPECT_THAT(Of(OneCause(), false),
              HasSubstr("eddy_current tau_us: 120 us (110 to 130, 90 % interval), de_x"));
}

TEST_F(Printed, ListsEightCandidatesAndAllOnlyWhenAsked) {
  DiagnosisReport report = OneCause();
  report.candidates.clear();
  for (int i = 0; i < 20; ++i) {
    report.candidates.push_back({.effect = "effect_" + std::to_string(i),
                                 .place = "p",
                                 .reason = "",
                                 .validation_nat = {}});
  }
  EXPECT_THAT(Of(report, false), HasSubstr("effect_7"));
  EXPECT_THAT(Of(report, false), Not(HasSubstr("effect_8")));
  EXPECT_THAT(Of(report, true), HasSubstr("effect_19"));
}

TEST_F(Printed, SaysOfEveryDecisiveCandidateWhyItIsNotTheAnswer) {
  DiagnosisReport report = OneCause();
  report.candidates.back().evidence_nat = 12.0;
  report.candidates.back().reason = "explains 28 nat less than the cause";
  EXPECT_THAT(Of(report, false), HasSubstr("explains 28 nat less than the cause"));
  report.candidates.back().evidence_nat = 4.0;
  EXPECT_THAT(Of(report, false), Not(HasSubstr("explains 28 nat")));
}

TEST_F(Printed, CallsNeighbouringFormsNoInterval) {
  DiagnosisReport report = OneCause();
  report.parameters[0].form = true;
  EXPECT_THAT(Of(report, false), HasSubstr("(110 to 130, neighbouring forms)"));
  EXPECT_THAT(Of(report, false), Not(HasSubstr("90 %")));
}

TEST_F(Printed, TellsWhichCandidatesTheScreenAloneHasSeen) {
  DiagnosisReport report = OneCause();
  EXPECT_THAT(Of(report, false), HasSubstr("(screen)"));
  for (auto& candidate : report.candidates) candidate.refitted = true;
  EXPECT_THAT(Of(report, false), Not(HasSubstr("(screen)")));
}

}  // namespace
}  // namespace levitas::report
