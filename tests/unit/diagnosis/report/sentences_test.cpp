#include "diagnosis/report/sentences.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/report/diagnosis/reports.hpp"

namespace levitas::diagnosis {
namespace {

using test::OneCause;
using test::ParameterAt;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(GainInWords, SaysWhatShareOfTheGainIsReachedAndWhoTakesIt) {
  DiagnosisReport report = OneCause();
  EXPECT_THAT(SentencesOf(report).gain, HasSubstr("reaches 95.0 % (90.0 to 99.0 %)"));
  EXPECT_THAT(SentencesOf(report).gain, HasSubstr("the cause takes 80 %"));
  report.validation.beyond_calibration = -0.1;
  EXPECT_THAT(SentencesOf(report).gain, HasSubstr("the cause adds 10 %"));
  report.validation.beyond_calibration = -0.001;
  EXPECT_THAT(SentencesOf(report).gain, HasSubstr("the cause takes"));
}

TEST(GainInWords, NamesTheEvidenceWhereCalibrationAloneLeavesNothing) {
  DiagnosisReport report = OneCause();
  report.validation.calibration_is_complete = true;
  EXPECT_THAT(SentencesOf(report).gain, HasSubstr("evidence of 40 nat"));
}

// Odds and evidence of a report are the first cause's own, wherever they are said.
TEST(GainInWords, NamesTheFirstCausesEvidenceAndNotThatOfAllTogether) {
  DiagnosisReport report = OneCause();
  report.causes.push_back({"sensor_gain", "de_y"});
  report.evidence_nat = 100.0;
  report.validation.calibration_is_complete = true;
  EXPECT_THAT(SentencesOf(report).gain, HasSubstr("evidence of 40 nat"));
  report.validation.meaningful = false;
  EXPECT_THAT(SentencesOf(report).gain, HasSubstr("evidence of 40 nat"));
}

TEST(GainInWords, CreditsCalibrationWhereThereIsNoCause) {
  DiagnosisReport report = OneCause();
  report.causes.clear();
  EXPECT_THAT(SentencesOf(report).gain, HasSubstr("by calibration"));
  EXPECT_THAT(SentencesOf(report).gain, Not(HasSubstr("the cause")));
}

TEST(GainInWords, PromisesNothingWhereTheFileAlreadyFits) {
  DiagnosisReport report = OneCause();
  report.validation.meaningful = false;
  report.causes.clear();
  report.verdict = Verdict::kNone;
  EXPECT_THAT(SentencesOf(report).gain, HasSubstr("Nothing to gain"));
}

TEST(GainInWords, NeverSaysNothingToGainBesideAnythingThatIsNotInOrder) {
  DiagnosisReport healthy = OneCause();
  healthy.validation.meaningful = false;
  healthy.causes.clear();
  healthy.verdict = Verdict::kNone;
  DiagnosisReport cause = OneCause();
  cause.validation.meaningful = false;
  EXPECT_THAT(SentencesOf(cause).gain, HasSubstr("40 nat decides"));
  DiagnosisReport unknown = healthy;
  unknown.verdict = Verdict::kUnknown;
  DiagnosisReport undecided = healthy;
  undecided.undecided = true;
  DiagnosisReport off = healthy;
  off.calibrated.emplace_back();
  off.calibrated.back().proven = 5.1;
  DiagnosisReport outside = healthy;
  outside.outside_tolerance = {"current_gain"};
  DiagnosisReport doubted = healthy;
  doubted.input_warning = "units";
  for (const DiagnosisReport& report : {cause, unknown, undecided, off, outside, doubted}) {
    EXPECT_THAT(SentencesOf(report).gain, Not(HasSubstr("Nothing to gain")));
    EXPECT_THAT(SentencesOf(report).gain, HasSubstr("nearly to their noise"));
  }
}

TEST(SentencesOf, HaveOnePerParameterValueCandidateAndMark) {
  DiagnosisReport report = OneCause();
  report.parameters = {ParameterAt("de_x"), ParameterAt("de_y")};
  report.parameters[1].form = true;
  report.calibrated.resize(2);
  report.calibrated[0].proven = 10.0;
  report.calibrated[0].moved = 3.0;
  report.marks = {{0.25, "breathing_crack"}, {0.1, "a place of its own"}};
  const ReportSentences said = SentencesOf(report);
  EXPECT_THAT(said.brackets,
              ElementsAre(testing::StrEq("90 % interval"), testing::StrEq("neighbouring forms")));
  EXPECT_EQ(said.significant.size(), 2U);
  EXPECT_FALSE(said.significant[1]);
  EXPECT_THAT(said.candidates, ElementsAre(Not(IsEmpty()), "Bent shaft"));
  EXPECT_THAT(said.marks,
              ElementsAre("Crack in the shaft, z = 250 mm", "a place of its own, z = 100 mm"));
  EXPECT_THAT(said.record_errors, IsEmpty());
}

TEST(SentencesOf, HaveTheIntervalsOfAForecastBandByBand) {
  DiagnosisReport report = OneCause();
  EXPECT_THAT(SentencesOf(report).forecast, IsEmpty());
  report.forecast.emplace();
  report.forecast->fit_percent = {40.0, 70.0, 55.0, true};
  report.forecast->by_speed = {{.from_rpm = 500.0,
                                .to_rpm = 1000.0,
                                .fit_percent = {10.0, 20.0, 15.0, true},
                                .residual_um = {2.0, 5.0, 3.5, true}}};
  const ReportSentences said = SentencesOf(report);
  EXPECT_EQ(said.forecast_fit, "40 to 70");
  ASSERT_EQ(said.forecast.size(), 1U);
  EXPECT_EQ(said.forecast[0].residual_um, "2 to 5");
  EXPECT_EQ(said.forecast[0].fit_percent, "10 to 20");
}

}  // namespace
}  // namespace levitas::diagnosis
