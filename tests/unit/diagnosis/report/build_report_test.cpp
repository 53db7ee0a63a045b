// The report holds what the search has found, and nothing in it needs the model.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/report/build_report.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(BuildReportTest, KeepsTheCauseWithItsPlaceChannelsAndFactor) {
  const DiagnosisReport report = BuildReport(Found(effect::Id::kCurrentGain, "nde_x"));
  EXPECT_EQ(report.verdict, Verdict::kEffect);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes[0].effect, "current_gain");
  EXPECT_EQ(report.causes[0].place, "nde_x");
  EXPECT_EQ(report.place, "amplifier");
  EXPECT_THAT(report.channels, ElementsAre("nde_x"));
  ASSERT_EQ(report.parameters.size(), 1U);
  EXPECT_EQ(report.parameters[0].unit, "");
  EXPECT_LT(report.parameters[0].low, report.parameters[0].value);
  EXPECT_GT(report.parameters[0].high, report.parameters[0].value);
}

TEST(BuildReportTest, OutlivesTheRigThatItWasBuiltFrom) {
  DiagnosisReport report;
  {
    const DiagnosisResult result = Found(effect::Id::kUnbalance, "z 299.2 mm");
    report = BuildReport(result);
  }
  EXPECT_EQ(report.channels.size(), 4U);
  EXPECT_FALSE(report.parameters.empty());
}

TEST(BuildReportTest, OfAHealthyRigHasNoCauseNoPlaceAndNoWarning) {
  const DiagnosisReport report = BuildReport(NothingFound());
  EXPECT_EQ(report.verdict, Verdict::kNone);
  EXPECT_THAT(report.causes, IsEmpty());
  EXPECT_EQ(report.place, "");
  EXPECT_EQ(report.input_warning, "");
  EXPECT_EQ(report.next_experiment, "none needed");
}

TEST(BuildReportTest, KeepsCandidatesInOrderWithAnImpossibleOneAsMinusInfinity) {
  DiagnosisResult result = Found(effect::Id::kCurrentGain, "nde_x");
  result.answer.candidates.push_back(
      {.effect = effect::Id::kHysteresis, .place = "de", .score = -INFINITY});
  const DiagnosisReport report = BuildReport(result);
  ASSERT_EQ(report.candidates.size(), 2U);
  EXPECT_EQ(report.candidates[0].evidence_nat, 20.0);
  EXPECT_EQ(report.candidates[1].effect, "hysteresis");
  EXPECT_EQ(report.candidates[1].evidence_nat, -INFINITY);
}

TEST(BuildReportTest, NamesTheShareOfEachChannelByItsChannel) {
  DiagnosisResult result = NothingFound();
  result.validation.to_gain = {0.5, 0.4, 0.6};
  result.validation.channel = {{0.1, 0.0, 0.2}, {0.8, 0.7, 0.9}};
  const ReportFit fit = BuildReport(result).validation;
  EXPECT_TRUE(fit.meaningful);
  ASSERT_EQ(fit.channels.size(), 2U);
  EXPECT_EQ(fit.channels[1].name, result.view->numbers.channels[1]);
  EXPECT_EQ(fit.channels[1].achieved.fraction, 0.8);
}

TEST(BuildReportTest, SaysWhichEffectsARotorAtRestCannotShow) {
  DiagnosisResult result = NothingFound();
  result.fastest_rad_per_s = 0.0;
  const DiagnosisReport report = BuildReport(result);
  EXPECT_THAT(report.coverage.effects, ::testing::Contains("unbalance"));
  EXPECT_NE(report.coverage.missing_records, "");
}

TEST(BuildReportTest, SaysOfEveryCandidateWhyItIsNotTheAnswer) {
  DiagnosisResult result = Found(effect::Id::kCurrentGain, "nde_x");
  const auto add = [&result](effect::Id effect, double nat) {
    result.answer.candidates.push_back({.effect = effect, .place = "de", .score = nat});
  };
  add(effect::Id::kSensorGain, 18.0);
  add(effect::Id::kExtraDelay, 12.0);
  add(effect::Id::kUnbalance, 1.0);
  add(effect::Id::kShaftBow, -2.0);
  add(effect::Id::kHysteresis, -INFINITY);
  result.answer.also_possible = {effect::Id::kSensorGain};
  std::vector<std::string> reasons;
  for (const ReportCandidate& c : BuildReport(result).candidates) reasons.push_back(c.reason);
  EXPECT_THAT(reasons,
              ElementsAre("named", "these data do not separate it from the cause",
                          "explains 8 nat less than the cause", "too little to be decisive",
                          "improves the fit by less than its Occam factor costs",
                          "would have to be negative, or cannot act in these data"));
}

TEST(BuildReportTest, HoldsTheTextOfTheRigFilesWhereARigIsGiven) {
  const DiagnosisResult result = Found(effect::Id::kEddyCurrent, "de_x");
  EXPECT_EQ(BuildReport(result).extended_rig, "");
  const DiagnosisReport report = BuildReport(result, FlexibleRotor());
  EXPECT_EQ(configuration::ParseRig(report.extended_rig, "extended_rig.yaml").plant.effects.size(),
            1U);
  EXPECT_EQ(
      configuration::ParseRig(report.calibrated_rig, "calibrated_rig.yaml").plant.effects.size(),
      1U);
}

}  // namespace
}  // namespace levitas::diagnosis
