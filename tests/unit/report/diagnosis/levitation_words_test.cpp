// What is said where a rig file that a diagnosis writes does not levitate, in all that is read.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/diagnosis/diagnosis_files.hpp"
#include "report/diagnosis/diagnosis_page.hpp"
#include "report/diagnosis/diagnosis_text.hpp"

namespace levitas::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kSentence = "calibrated_rig.yaml DOES NOT LEVITATE under <law>.";

diagnosis::DiagnosisReport Judged(bool levitates) {
  diagnosis::DiagnosisReport report;
  report.rig_name = "rig";
  diagnosis::ReportLevitation of{.law = "law", .from_rpm = 0.0, .to_rpm = 3000.0};
  of.rig_file.levitates = of.extended_rig.levitates = true;
  of.calibrated_rig = {.levitates = levitates, .rpm = levitates ? 0.0 : 1500.0};
  report.levitation.by_law = {of};
  if (!levitates) report.levitation.sentences = {kSentence};
  return report;
}

std::string PrintedText(const diagnosis::DiagnosisReport& report) {
  ::testing::internal::CaptureStdout();
  PrintDiagnosis(report, false);
  return ::testing::internal::GetCapturedStdout();
}

TEST(LevitationWords, AreOnTheTerminalOfARigThatDoesNotLevitateAlone) {
  EXPECT_THAT(PrintedText(Judged(false)), HasSubstr(kSentence));
  EXPECT_THAT(PrintedText(Judged(true)), Not(HasSubstr("LEVITATE")));
}

TEST(LevitationWords, AreOnThePageOfARigThatDoesNotLevitateAlone) {
  EXPECT_THAT(DiagnosisPage(Judged(false)), HasSubstr("DOES NOT LEVITATE under &lt;law&gt;."));
  EXPECT_THAT(DiagnosisPage(Judged(true)), Not(HasSubstr("LEVITATE")));
}

TEST(LevitationWords, AreInTheJsonWithTheAnswerOfEveryFile) {
  const auto falls = DiagnosisJson(Judged(false))["levitation"];
  EXPECT_EQ(falls["sentences"][0], kSentence);
  EXPECT_EQ(falls["laws"][0]["calibrated_rig"]["levitates"], false);
  EXPECT_EQ(falls["laws"][0]["calibrated_rig"]["speed_rpm"], 1500.0);
  EXPECT_EQ(falls["laws"][0]["extended_rig"]["levitates"], true);
  const auto holds = DiagnosisJson(Judged(true))["levitation"];
  EXPECT_TRUE(holds["sentences"].empty());
  EXPECT_EQ(holds["laws"][0]["calibrated_rig"]["levitates"], true);
  EXPECT_FALSE(holds["laws"][0]["calibrated_rig"].contains("speed_rpm"));
}

TEST(LevitationWords, OfARigThatWasNotJudgedAreNullInTheJson) {
  diagnosis::DiagnosisReport report = Judged(true);
  report.levitation.by_law[0].calibrated_rig = {.levitates = std::nullopt, .why = "no"};
  const auto loop = DiagnosisJson(report)["levitation"]["laws"][0]["calibrated_rig"];
  EXPECT_TRUE(loop["levitates"].is_null());
  EXPECT_EQ(loop["why"], "no");
  EXPECT_FALSE(loop.contains("speed_rpm"));
}

}  // namespace
}  // namespace levitas::report
