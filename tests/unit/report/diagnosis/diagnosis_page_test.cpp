#include "report/diagnosis/diagnosis_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/diagnosis/rotor_sketch.hpp"
#include "tests/unit/report/diagnosis/reports.hpp"

namespace levitas::report {
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
  report.headline = report.action = report.severity_sentence = report.healthy_proposal = kMark;
  report.healthy_record = kMark;
  report.rotor = {.pieces = {{0.0, 0.4, 0.03, 0.0, false}}, .bearings = {{kMark, 0.1, 0.1}}};
  report.marks = {{0.1, kMark}};
  report.origin.records = {kMark};
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

diagnosis::DiagnosisReport WithRotor() {
  DiagnosisReport report = OneCause();
  report.rotor.pieces = {{0.0, 0.4, 0.03, 0.0, false}, {0.19, 0.21, 0.12, 0.03, true}};
  report.rotor.bearings = {{"de", 0.05, 0.08}, {"nde", 0.35, 0.32}};
  report.marks = {{0.25, "breathing_crack"}};
  return report;
}

TEST(DiagnosisPage, DrawsTheRotorWithThePlaceOfTheCause) {
  const std::string page = DiagnosisPage(WithRotor());
  EXPECT_EQ(Count(page, "<svg"), 2U);
  EXPECT_THAT(page, HasSubstr("Crack in the shaft, z = 250 mm"));
  // 680 px from 0 to 400 mm, 40 px of margin: 250 mm are at 465.
  EXPECT_THAT(page, HasSubstr("<line x1=\"465.0\""));
  DiagnosisReport geared = WithRotor();
  geared.rotor.pieces.clear();
  EXPECT_EQ(Count(DiagnosisPage(geared), "<svg"), 1U);
  EXPECT_EQ(RotorSketch(geared, {}), "");
}

TEST(DiagnosisPage, SaysWhenOfWhichFilesAndByWhichVersionItIs) {
  DiagnosisReport report = OneCause();
  EXPECT_THAT(DiagnosisPage(report), Not(HasSubstr("class=\"origin\"")));
  report.origin = {.date_utc = "2026-11-27T12:00:00Z",
                   .program_version = "9.8.7",
                   .rig_file = "mine.yaml",
                   .records = {"a.csv", "b<c.csv"},
                   .validation = {"v.csv"},
                   .healthy = {},
                   .quick = true};
  const std::string page = DiagnosisPage(report);
  for (const char* part : {"2026-11-27T12:00:00Z", "Levitas 9.8.7", "mine.yaml",
                           "Records: a.csv, b&lt;c.csv.", "Validation: v.csv.", "--quick"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
}

TEST(DiagnosisPage, RaisesTheExponentOfOdds) {
  DiagnosisReport report = OneCause();
  report.headline = "Crack: odds 10^2160 : 1.";
  EXPECT_THAT(DiagnosisPage(report), HasSubstr("odds 10<sup>2160</sup> : 1."));
}

TEST(DiagnosisPage, NamesTheAxesOfTheResidualWithTheirUnits) {
  const std::string page = DiagnosisPage(OneCause());
  EXPECT_THAT(page, HasSubstr(">frequency, Hz<"));
  EXPECT_THAT(page, HasSubstr(">residual power / sensor noise power, 1<"));
}

TEST(DiagnosisPage, DrawsTheCauseOnlyWhereThereIsOne) {
  EXPECT_THAT(DiagnosisPage(OneCause()), HasSubstr("with the cause<"));
  DiagnosisReport healthy = OneCause();
  healthy.causes.clear();
  EXPECT_THAT(DiagnosisPage(healthy), Not(HasSubstr("with the cause<")));
}

TEST(DiagnosisPage, ShowsNoNumberForAnEffectThatCannotBe) {
  EXPECT_THAT(DiagnosisPage(OneCause()),
              HasSubstr("<td>Bent shaft</td><td>shaft_bow</td><td>rotor</td><td "
                        "class=n>-</td><td>needs rotation"));
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
}  // namespace levitas::report
