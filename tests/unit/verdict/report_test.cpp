#include "verdict/report.hpp"
#include "common/rotational_speed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/unit/verdict/synthetic_session.hpp"

namespace levitas::verdict {
namespace {

using testing::HasSubstr;

Inputs FullRun() {
  SyntheticSession session;
  session.Append(Mode::kLevitating, 400, {.radius_m = 4e-6, .static_a = 0.25});
  session.Append(Mode::kSpinning, 400,
                 {.radius_m = 20e-6, .speed_rad_per_s = RpmToRadPerS(3000.0)});
  Inputs inputs;
  inputs.rig = TwoBearingRig();
  inputs.session = session.Figures(inputs.rig);
  inputs.provenance.rig = "test_rig";
  inputs.provenance.pace = "realtime";
  inputs.provenance.seed = 7;
  analysis::SensitivityResult loop;
  loop.stable = true;
  loop.axes.resize(4, {.peak = 2.5, .frequency_hz = 95.0, .zone = Zone::kA, .margins = {}});
  analysis::SensitivityResult unstable;
  unstable.speed_rad_per_s = 314.0;
  unstable.axes.resize(4, {.peak = 9.0, .frequency_hz = 95.0, .zone = {}, .margins = {}});
  inputs.sensitivity = {loop, unstable};
  TimingFigures timing;
  timing.wall_s = 0.04;
  timing.cycles_per_s = 20'000.0;
  timing.times_real_time = 2.0;
  timing.durations = {{"wakeup", 800, 50.0, 5'300.0, 39'000.0, 2.5e6}};
  inputs.timing = timing;
  return inputs;
}

TEST(Table, FitsAHundredColumnsWithoutControlCodes) {
  Inputs inputs = FullRun();
  inputs.rig.bearings = {"drive_end", "free_end"};
  inputs.rig.channels = {"drive_end_x", "drive_end_y", "free_end_x", "free_end_y"};
  inputs.session.spinning.bearings[0].orbit.max_m = 199.99e-6;
  inputs.session.spinning.bearings[0].orbit.max_time_s = 9'999.99;
  const Verdict verdict = Judge(inputs);
  const std::string table = Table(verdict);
  std::istringstream lines(table);
  std::string line;
  while (std::getline(lines, line)) {
    if (line == verdict.sentence) continue;  // one sentence is one line, however long
    EXPECT_LE(line.size(), 100U) << line;
    for (const char c : line) EXPECT_TRUE(c >= ' ' && c <= '~') << line;
  }
}

TEST(Table, ShowsEveryFigureWithItsUnitAndEndsWithTheSentence) {
  const Verdict verdict = Judge(FullRun());
  const std::string table = Table(verdict);
  EXPECT_TRUE(std::regex_search(table, std::regex("de +standing +4\\.00 +4\\.00 +0\\.00 +7\\.0")));
  EXPECT_TRUE(
      std::regex_search(table, std::regex("nde +spinning +20\\.00 .* 0\\.100 +A +3000 rpm")));
  EXPECT_TRUE(std::regex_search(table, std::regex("de_x +standing +0\\.2500 +0\\.0000 +0\\.2500")));
  EXPECT_THAT(table, HasSubstr("20000 cycles/s, 2.00 x real time"));
  EXPECT_TRUE(std::regex_search(table, std::regex("wakeup +50 ns +5\\.3 us +39\\.0 us +2\\.5 ms")));
  EXPECT_TRUE(table.ends_with("\n" + verdict.sentence + "\n"));
}

TEST(Table, GivesAnUnstableLoopNoZone) {
  const std::string table = Table(Judge(FullRun()));
  EXPECT_TRUE(std::regex_search(table, std::regex("de_x +0 +2\\.500 +95\\.0 +A")));
  EXPECT_TRUE(std::regex_search(table, std::regex("de_x +2998 +9\\.000 +95\\.0 +none: unstable")));
}

TEST(Json, CarriesTheFiguresInSi) {
  const nlohmann::json json = nlohmann::json::parse(Json(Judge(FullRun())).dump());
  EXPECT_EQ(json["verdict"], "not_accepted");  // one loop is unstable
  EXPECT_EQ(json["orbits"].size(), 4U);
  EXPECT_EQ(json["orbits"][0]["bearing"], "de");
  EXPECT_EQ(json["orbits"][0]["phase"], "standing");
  EXPECT_NEAR(json["orbits"][0]["max_m"].get<double>(), 4e-6, 1e-15);
  EXPECT_EQ(json["orbits"][0]["clearance_zone"], "A");
  EXPECT_EQ(json["orbits"][2]["phase"], "spinning");
  EXPECT_NEAR(json["orbits"][2]["max_at_speed_rpm"].get<double>(), 3000.0, 1e-9);
  EXPECT_NEAR(json["currents"][0]["mean_a"].get<double>(), 0.25, 1e-12);
  EXPECT_EQ(json["timing"]["durations"]["wakeup"]["p99_ns"], 5300.0);
  EXPECT_EQ(json["provenance"]["seed"], 7);
  EXPECT_TRUE(json["trip"].is_null());
}

TEST(Json, WritesNoZoneForAnUnstableLoopAndNullForInfinity) {
  Inputs inputs = FullRun();
  inputs.session.standing.bearings[0].orbit.max_m = std::numeric_limits<double>::infinity();
  const nlohmann::json json = nlohmann::json::parse(Json(Judge(inputs)).dump());
  EXPECT_EQ(json["sensitivity"][0]["axes"][0]["zone"], "A");
  EXPECT_TRUE(json["sensitivity"][1]["axes"][0]["zone"].is_null());
  EXPECT_FALSE(json["sensitivity"][1]["stable"].get<bool>());
  EXPECT_TRUE(json["orbits"][0]["max_m"].is_null());
}

TEST(Json, NamesTheTripWithItsFigures) {
  Inputs inputs = FullRun();
  inputs.session.trip = TripFigures{Fault::kCoilSaturated, 3, 0.2, 0.1, 1.5, Mode::kLift, 0.0};
  inputs.session.trips = 1;
  inputs.provenance.trip_file = "trip_0001.lcmlog";
  const nlohmann::json json = nlohmann::json::parse(Json(Judge(inputs)).dump());
  EXPECT_EQ(json["verdict"], "tripped");
  EXPECT_EQ(json["trip"]["fault"], "coil_saturated");
  EXPECT_EQ(json["trip"]["axis"], "nde_y");
  EXPECT_EQ(json["trip"]["value_si"], 0.2);
  EXPECT_EQ(json["trip"]["mode_before"], "lift");
  EXPECT_EQ(json["trip"]["file"], "trip_0001.lcmlog");
}

}  // namespace
}  // namespace levitas::verdict
