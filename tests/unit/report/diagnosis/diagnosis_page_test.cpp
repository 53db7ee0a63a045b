#include "report/diagnosis/diagnosis_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/report/diagnosis/reports.hpp"

namespace levitas::cli {
namespace {

using diagnosis::DiagnosisReport;
using diagnosis::test::OneCause;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kMark = "<img src=x>";

std::size_t Count(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(DiagnosisPage, NeedsNothingBesideIt) {
  const std::string page = DiagnosisPage(OneCause());
  EXPECT_EQ(Count(page, "<script"), 0U);
  EXPECT_EQ(Count(page, "<link"), 0U);
  EXPECT_EQ(Count(page, "src="), 0U);
  EXPECT_EQ(Count(page, "<svg"), 1U);
}

TEST(DiagnosisPage, ClosesEveryTableRowAndDetailThatItOpens) {
  const std::string page = DiagnosisPage(OneCause());
  for (const std::string tag : {"table", "tr", "td", "details", "p", "body", "html"}) {
    EXPECT_EQ(Count(page, "<" + tag + ">") + Count(page, "<" + tag + " "),
              Count(page, "</" + tag + ">"))
        << tag;
  }
}

// Names come from files of others: of rigs, of channels, of records.
TEST(DiagnosisPage, ShowsNamesOfOthersAsTextWhateverTheyHold) {
  DiagnosisReport report = OneCause();
  report.rig_name = kMark;
  report.verdict_sentence = kMark;
  report.next_experiment = kMark;
  report.healthy_sentence = kMark;
  report.spectra.channel = kMark;
  report.parameters[0].location.name = kMark;
  report.candidates[0].place = kMark;
  report.taken_by_causes = {kMark};
  report.validation.channels = {{.name = kMark, .achieved = {}}};
  diagnosis::CalibratedValue value;
  value.effect = "sensor_gain";
  value.place = kMark;
  report.calibrated = {value};
  diagnosis::ReportRun run;
  run.name = kMark;
  report.validation_runs = {run};
  const std::string page = DiagnosisPage(report);
  EXPECT_THAT(page, Not(HasSubstr(kMark)));
  EXPECT_GE(Count(page, "&lt;img src=x&gt;"), 9U);
}

TEST(DiagnosisPage, DrawsTheCauseOnlyWhereThereIsOne) {
  EXPECT_THAT(DiagnosisPage(OneCause()), HasSubstr("with the cause<"));
  DiagnosisReport healthy = OneCause();
  healthy.causes.clear();
  EXPECT_THAT(DiagnosisPage(healthy), Not(HasSubstr("with the cause<")));
}

TEST(DiagnosisPage, ShowsNoNumberForAnEffectThatCannotBe) {
  EXPECT_THAT(DiagnosisPage(OneCause()),
              HasSubstr("<td>shaft_bow</td><td>rotor</td><td class=n>-</td><td>needs rotation"));
}

TEST(DiagnosisPage, FoldsWhatComesBehindTheFirstEightCandidates) {
  DiagnosisReport report = OneCause();
  report.candidates.clear();
  for (int i = 0; i < 10; ++i) {
    report.candidates.push_back({.effect = "effect_" + std::to_string(i),
                                 .place = "p",
                                 .reason = "",
                                 .validation_nat = {}});
  }
  const std::string page = DiagnosisPage(report);
  const std::size_t fold = page.find("All others that were ruled out");
  ASSERT_NE(fold, std::string::npos);
  EXPECT_LT(page.find("effect_7"), fold);
  EXPECT_GT(page.find("effect_8"), fold);
}

TEST(DiagnosisPage, SaysOfHowMuchOfTheRecordsItSpeaks) {
  DiagnosisReport report = OneCause();
  EXPECT_THAT(DiagnosisPage(report), HasSubstr("From 12.0 s in flight."));
  report.seconds_used = 3.0;
  EXPECT_THAT(DiagnosisPage(report), HasSubstr("From 3.0 s of 12.0 s in flight"));
}

TEST(DiagnosisPage, PutsErrorsOfARecordBeforeTheVerdict) {
  DiagnosisReport report = OneCause();
  diagnosis::RecordErrors errors;
  errors.record = "run.csv";
  errors.errors.emplace_back();
  errors.errors.back().sentence = "de_x and de_y are exchanged";
  report.record_errors = {errors};
  const std::string page = DiagnosisPage(report);
  ASSERT_NE(page.find("exchanged"), std::string::npos);
  EXPECT_LT(page.find("exchanged"), page.find("Eddy currents on de_x."));
}

}  // namespace
}  // namespace levitas::cli
