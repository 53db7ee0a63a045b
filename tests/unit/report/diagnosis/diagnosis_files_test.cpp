#include "report/diagnosis/diagnosis_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/problem.hpp"
#include "report/diagnosis/old_keys.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/report/diagnosis/reports.hpp"

namespace levitas::report {
namespace {

using diagnosis::DiagnosisReport;
using diagnosis::test::OneCause;

std::string Content(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(DiagnosisJson, NamesTheFirstCauseAndAllInTheirOrder) {
  DiagnosisReport report = OneCause();
  report.causes.push_back({"sensor_gain", "de_y"});
  const auto json = DiagnosisJson(report);
  EXPECT_EQ(json["verdict"], "effect");
  EXPECT_EQ(json["cause"], "eddy_current");
  EXPECT_EQ(json["all_causes"], (std::vector<std::string>{"eddy_current", "sensor_gain"}));
}

TEST(DiagnosisJson, OfAHealthyRigHasNoCause) {
  DiagnosisReport report = OneCause();
  report.verdict = diagnosis::Verdict::kNone;
  report.causes.clear();
  const auto json = DiagnosisJson(report);
  EXPECT_EQ(json["verdict"], "none");
  EXPECT_TRUE(json["cause"].is_null());
  EXPECT_TRUE(json["all_causes"].empty());
}

TEST(DiagnosisJson, SaysWhetherABracketIsAnInterval) {
  DiagnosisReport report = OneCause();
  EXPECT_EQ(DiagnosisJson(report)["parameters"]["tau_us[de_x]"]["bracket"], "5 to 95 %");
  report.parameters[0].form = true;
  EXPECT_EQ(DiagnosisJson(report)["parameters"]["tau_us[de_x]"]["bracket"], "neighbouring forms");
}

TEST(DiagnosisJson, HasTheFilesOwnValueOnlyWhereTheParameterIsAddedToIt) {
  DiagnosisReport report = OneCause();
  EXPECT_FALSE(DiagnosisJson(report)["parameters"]["tau_us[de_x]"].contains("with_file"));
  report.parameters[0].of_file = {{30.0, 150.0}};
  EXPECT_EQ(DiagnosisJson(report)["parameters"]["tau_us[de_x]"]["of_file"], 30.0);
  EXPECT_EQ(DiagnosisJson(report)["parameters"]["tau_us[de_x]"]["with_file"], 150.0);
}

// JSON has no infinity and no NaN: readers of other languages would refuse the file.
TEST(DiagnosisJson, IsSoundAlsoWhereANumberIsNotFinite) {
  DiagnosisReport report = OneCause();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  report.forecast.emplace();
  report.forecast->fit_percent = {nan, 90.0, 80.0, false};
  report.forecast->by_speed = {{.from_rpm = 100.0,
                                .to_rpm = 200.0,
                                .fit_percent = {nan, nan, nan, false},
                                .residual_um = {0.1, 0.3, 0.2, true}}};
  const std::string text = DiagnosisJson(report).dump();
  const auto json = nlohmann::json::parse(text);
  EXPECT_TRUE(json["forecast"]["fit_percent_low"].is_null());
  EXPECT_EQ(json["forecast"]["fit_percent_high"], 90.0);
  EXPECT_EQ(json["forecast"]["by_speed"][0]["residual_um_measured"], 0.2);
  EXPECT_TRUE(json["forecast"]["by_speed"][0]["covered"]);
  ASSERT_EQ(json["candidates"].size(), 2U);  // of which one cannot be: minus infinity
  EXPECT_EQ(text.find("inf"), std::string::npos);
}

TEST(DiagnosisJson, HasAForecastOnlyWhereOneWasMade) {
  EXPECT_TRUE(DiagnosisJson(OneCause())["forecast"].is_null());
}

// Scripts of version 1.0 read these.
TEST(DiagnosisJson, HasWhatValidationDataSayUnderOneWordAndUnderTheOldKeys) {
  DiagnosisReport report = OneCause();
  report.validation.nominal_percent = 11.0;
  report.validation.calibrated_percent = 22.0;
  report.validation.extended_percent = 33.0;
  report.candidates[0].validation_nat = 44.0;
  report.candidates[1].validation_nat.reset();
  diagnosis::ReportRun run;
  run.name = "v.mat";
  report.validation_runs = report.fitted_runs = {run};
  const auto json = nlohmann::json::parse(DiagnosisJson(report).dump());
  for (const std::string word : {"validation", "holdout"}) {
    EXPECT_EQ(json["fit_percent"][word + "_before"], 11.0);
    EXPECT_EQ(json["fit_percent"][word + "_calibrated"], 22.0);
    EXPECT_EQ(json["fit_percent"][word + "_after"], 33.0);
  }
  const std::string old_nat = std::string("held") + "_out_nat";
  EXPECT_EQ(json["candidates"][0]["validation_nat"], 44.0);
  EXPECT_EQ(json["candidates"][0][old_nat], 44.0);
  EXPECT_FALSE(json["candidates"][1].contains(old_nat));
  ASSERT_EQ(json["runs_validation"].size(), 1U);
  EXPECT_EQ(json["runs_validation"], json[std::string("runs_held") + "_out"]);
}

TEST(OldKeys, ComeOnlyWithTheNewOnes) {
  nlohmann::ordered_json none{{"fit_percent", {{"before", 1.0}}},
                              {"candidates", {{{"effect", "a"}}}}};
  const nlohmann::ordered_json before = none;
  AddOldKeys(none);
  EXPECT_EQ(none, before);
  nlohmann::ordered_json empty = nlohmann::ordered_json::object();
  AddOldKeys(empty);
  EXPECT_TRUE(empty.empty());
}

TEST(WriteDiagnosis, WritesTheFourFilesItNames) {
  const levitas::test::ScratchFolder folder;
  const std::string here = folder / "";
  const DiagnosisReport report = OneCause();
  const auto paths = WriteDiagnosis(report, here);
  ASSERT_EQ(paths.size(), 4U);
  EXPECT_EQ(nlohmann::json::parse(Content(folder / "diagnosis.json")),
            nlohmann::json::parse(DiagnosisJson(report).dump()));
  EXPECT_EQ(Content(folder / "extended_rig.yaml"), report.extended_rig);
  EXPECT_EQ(Content(folder / "calibrated_rig.yaml"), report.calibrated_rig);
  EXPECT_NE(Content(folder / "report.html").find("Eddy currents on de_x."), std::string::npos);
}

TEST(WriteDiagnosis, RefusesAFolderThatIsNotThere) {
  const levitas::test::ScratchFolder folder;
  EXPECT_THROW((void)WriteDiagnosis(OneCause(), folder / "nowhere"), BadInput);
}

}  // namespace
}  // namespace levitas::report
