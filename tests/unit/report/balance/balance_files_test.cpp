#include "report/balance/balance_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <complex>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "tests/support/scratch_folder.hpp"

namespace levitas::report {
namespace {

using balancing::BalanceRequest;
using balancing::BalanceResult;
using testing::HasSubstr;
using testing::Not;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRpm = 2.0 * std::numbers::pi / 60.0;

/// One plane with a correction of 50 g mm at 30 degrees, at a radius of 25 mm: 2 g.
class Balanced : public testing::Test {
 protected:
  Balanced() {
    request_.rig.numbers.name = "test_rig";
    request_.rig.numbers.bearings = {"de", "nde"};
    balancing::RecordedRun run;
    run.name = "run_up.lcm";
    request_.runs = {run};
    request_.top_rad_per_s = 3000.0 * kRpm;
    result_.fit.reduced_chi_square = 1.0;
    result_.fit.converged = true;
    result_.fit.windows = 42;
    result_.lowest_rad_per_s = 300.0 * kRpm;
    result_.highest_rad_per_s = 3000.0 * kRpm;
    result_.left_share = 0.05;
    result_.planes = {{.name = "disc",
                       .z_m = 0.3,
                       .unbalance_kg_m = std::polar(50e-6, 210.0 * kDegree),
                       .deviation_kg_m = 1e-6,
                       .angle_deviation_rad = 0.02}};
    balancing::CorrectionResult correction;
    correction.plane.name = "disc";
    correction.plane.z_m = 0.3;
    correction.plane.radius_m = 25e-3;
    correction.added_kg_m = std::polar(50e-6, 30.0 * kDegree);
    correction.placed.weights = {{.hole = 0, .angle_rad = 30.0 * kDegree, .mass_kg = 2e-3}};
    correction.placed.moment_kg_m = correction.added_kg_m;
    result_.corrections = {correction};
    for (int i = 1; i <= 3; ++i) {
      balancing::OrbitForecast at;
      at.speed_rad_per_s = 1000.0 * i * kRpm;
      at.before_m = Eigen::VectorXd::Constant(2, 20e-6);
      at.after_m = Eigen::VectorXd::Constant(2, 1e-6);
      at.after_high_m = Eigen::VectorXd::Constant(2, 2e-6);
      result_.orbits.push_back(at);
    }
  }
  [[nodiscard]] std::string Text() const { return BalanceText(request_, result_); }
  [[nodiscard]] nlohmann::ordered_json Json() const { return BalanceJson(request_, result_); }

  BalanceRequest request_;
  BalanceResult result_;
};

TEST_F(Balanced, SaysWhichCorrectionIsNotToldFromNothing) {
  result_.corrections[0].deviation_kg_m = 25e-6;
  EXPECT_THAT(Text(), Not(HasSubstr("may be none at all")));
  result_.corrections[0].deviation_kg_m = 26e-6;
  EXPECT_THAT(Text(), HasSubstr("disc: may be none at all: 50.000 g mm, give or take 50.960; "
                                "without a plane disc the others have smaller intervals"));
}

TEST_F(Balanced, SaysWhatIsUnlikelyWhereTheRunIsNotExplained) {
  EXPECT_THAT(Text(), Not(HasSubstr("WARNING")));
  result_.fit.reduced_chi_square = 9.0;
  EXPECT_THAT(Text(), HasSubstr("unbalance in these planes does not explain the run"));
  request_.runs.push_back(request_.runs.front());
  EXPECT_THAT(Text(), HasSubstr("the two runs do not differ by the weights of --applied"));
}

TEST_F(Balanced, TellsUnbalanceAndWeightInGramsAndDegrees) {
  const auto json = Json();
  EXPECT_NEAR(json["unbalance"][0]["moment_g_mm"].get<double>(), 50.0, 1e-9);
  EXPECT_NEAR(json["unbalance"][0]["angle_deg"].get<double>(), -150.0, 1e-9);
  const auto& correction = json["corrections"][0];
  EXPECT_NEAR(correction["moment_g_mm"].get<double>(), 50.0, 1e-9);
  EXPECT_NEAR(correction["angle_deg"].get<double>(), 30.0, 1e-9);
  EXPECT_NEAR(correction["mass_g"].get<double>(), 2.0, 1e-9);
  EXPECT_NEAR(correction["weights"][0]["mass_g"].get<double>(), 2.0, 1e-9);
  EXPECT_NEAR(correction["off_g_mm"].get<double>(), 0.0, 1e-9);
  EXPECT_EQ(json["method"], "add");
}

// A hole takes mass away: it is drilled where the weight would not be.
TEST_F(Balanced, TurnsTheCorrectionOverWhereMassIsTakenAway) {
  request_.planes.drill = true;
  const auto json = Json();
  EXPECT_NEAR(json["corrections"][0]["angle_deg"].get<double>(), -150.0, 1e-9);
  EXPECT_EQ(json["method"], "drill");
  EXPECT_THAT(Text(), HasSubstr("mass taken away"));
}

TEST_F(Balanced, OfAPlaneWithoutARadiusKnowsNoMass) {
  result_.corrections[0].plane.radius_m = 0.0;
  EXPECT_FALSE(Json()["corrections"][0].contains("mass_g"));
  EXPECT_FALSE(Json()["corrections"][0].contains("weights"));
}

TEST_F(Balanced, NamesAHoleOnlyWhereThereIsOne) {
  EXPECT_FALSE(Json()["corrections"][0]["weights"][0].contains("hole"));
  EXPECT_THAT(Text(), Not(HasSubstr("hole")));
  result_.corrections[0].placed.weights[0].hole = 4;
  EXPECT_EQ(Json()["corrections"][0]["weights"][0]["hole"], 4);
  EXPECT_THAT(Text(), HasSubstr("hole 4 (30.0 deg): 2.000 g"));
}

TEST_F(Balanced, SaysThatACorrectionIsTooSmallForAnyWeight) {
  result_.corrections[0].placed.weights.clear();
  EXPECT_THAT(Text(), HasSubstr("disc: no weight, the correction is below the smallest"));
}

TEST_F(Balanced, WarnsWhereItsPlanesDoNotExplainTheRun) {
  result_.fit.reduced_chi_square = 1.4 * 1.4;
  EXPECT_THAT(Text(), Not(HasSubstr("WARNING")));
  result_.fit.reduced_chi_square = 2.6 * 2.6;
  EXPECT_THAT(Text(), HasSubstr("WARNING: unbalance in these planes does not explain the run"));
}

TEST_F(Balanced, WarnsOfAFitThatDidNotSettle) {
  EXPECT_THAT(Text(), Not(HasSubstr("WARNING")));
  result_.fit.converged = false;
  EXPECT_THAT(Text(), HasSubstr("WARNING: the fit did not settle"));
  EXPECT_FALSE(Json()["converged"]);
}

TEST_F(Balanced, WarnsOfAForecastBeyondTheRecord) {
  EXPECT_THAT(Text(), Not(HasSubstr("NOTE")));
  result_.highest_rad_per_s = 2000.0 * kRpm;
  EXPECT_THAT(Text(), HasSubstr("NOTE: the record ends at 2000 rpm"));
}

TEST_F(Balanced, MeasuresACoupleInGramSquareMillimetres) {
  result_.modal = {{.name = "static", .frequency_hz = 0.0, .before = 50e-6, .after = 1e-6},
                   {.name = "couple", .frequency_hz = 0.0, .before = 7e-9, .after = 0.0}};
  const auto json = Json();
  EXPECT_NEAR(json["modal"][0]["before_g_mm"].get<double>(), 50.0, 1e-9);
  EXPECT_NEAR(json["modal"][1]["before_g_mm2"].get<double>(), 7.0, 1e-9);
  EXPECT_FALSE(json["modal"][1].contains("before_g_mm"));
}

TEST_F(Balanced, HoldsTheOrbitOfEachBearingBeforeAndAfter) {
  const auto json = Json();
  ASSERT_EQ(json["orbits"].size(), 3U);
  EXPECT_NEAR(json["orbits"][1]["speed_rpm"].get<double>(), 2000.0, 1e-9);
  EXPECT_NEAR(json["orbits"][1]["nde"]["before_um"].get<double>(), 20.0, 1e-9);
  EXPECT_NEAR(json["orbits"][1]["nde"]["after_um"].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(json["left_percent"].get<double>(), 5.0, 1e-9);
}

TEST_F(Balanced, DrawsAPanelPerBearingAndNothingWithoutAPath) {
  const levitas::test::ScratchFolder folder;
  WriteBalancePicture(folder / "b.svg", request_, result_);
  std::ifstream file(folder / "b.svg");
  std::ostringstream svg;
  svg << file.rdbuf();
  EXPECT_THAT(svg.str(), HasSubstr(">de<"));
  EXPECT_THAT(svg.str(), HasSubstr(">nde<"));
  WriteBalancePicture("", request_, result_);
  EXPECT_FALSE(std::filesystem::exists(""));
}

}  // namespace
}  // namespace levitas::report
