#include "report/identification/geared_files.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/report/identification/written.hpp"

namespace levitas::cli {
namespace {

using identification::GearedLine;
using identification::GearedParameters;

TEST(GearedJson, WritesComplexNumbersAsAmplitudeAndPhase) {
  GearedParameters found;
  found.pinion.run_out_m = std::polar(20e-6, 0.6);
  found.pinion.ks_n_per_m = 1e5;
  found.gear.ki_n_per_a = 80.0;
  found.error = {{.harmonic = -2, .amplitude_m = std::polar(4e-6, -1.1), .sigma = 1e-8}};
  found.mesh_stiffness_n_per_m = 1e6;
  const auto json = GearedJson(found);
  EXPECT_NEAR(json["pinion"]["run_out_m"].get<double>(), 20e-6, 1e-18);
  EXPECT_NEAR(json["pinion"]["run_out_phase_rad"].get<double>(), 0.6, 1e-12);
  EXPECT_EQ(json["pinion"]["ks_n_per_m"], 1e5);
  EXPECT_EQ(json["gear"]["ki_n_per_a"], 80.0);
  EXPECT_EQ(json["mesh_stiffness_n_per_m"], 1e6);
  ASSERT_EQ(json["transmission_error"].size(), 1U);
  EXPECT_EQ(json["transmission_error"][0]["order"], -2);
  EXPECT_NEAR(json["transmission_error"][0]["amplitude_m"].get<double>(), 4e-6, 1e-18);
  EXPECT_NEAR(json["transmission_error"][0]["phase_rad"].get<double>(), -1.1, 1e-12);
}

TEST(GearedJson, WithoutALineOfTheErrorHasNoList) {
  EXPECT_FALSE(GearedJson({}).contains("transmission_error"));
}

TEST(GearedJson, SaysWhereProbesBesideTheGearStandAndNothingOfThoseAtIt) {
  GearedParameters found;
  found.gear.plane = {0.26, 0.2, 4.5, 1.3, -200.0 * std::numbers::pi, 2};
  const auto json = GearedJson(found);
  EXPECT_FALSE(json["pinion"].contains("probe_plane"));
  const auto& plane = json["gear"]["probe_plane"];
  EXPECT_EQ(plane["probe_z_m"], 0.26);
  EXPECT_EQ(plane["median"]["ratio"], 1.3);
  EXPECT_EQ(plane["largest"]["ratio"], 4.5);
  EXPECT_NEAR(plane["largest"]["at_hz"].get<double>(), -100.0, 1e-9);
  EXPECT_EQ(plane["lines_left_out"]["count"], 2);
  const std::string text = ProbePlaneText("gear", *found.gear.plane);
  EXPECT_EQ(test::Count(text, "60 mm from the gear"), 1U);
  EXPECT_EQ(test::Count(text, "1.3 times as far as they do, 4.5 times at -100 Hz"), 1U);
  EXPECT_EQ(test::Count(text, "2 line(s) left out"), 1U);
}

GearedLine At(double speed_rad_per_s, double frequency_hz) {
  GearedLine line;
  line.speed_rad_per_s = speed_rad_per_s;
  line.frequency_rad_per_s = 2.0 * std::numbers::pi * frequency_hz;
  line.pinion_m = 10e-6;
  line.gear_m = 5e-6;
  return line;
}

TEST(GearedPicture, HasAPanelPerShaftAndNamesEachSpeedInBoth) {
  const levitas::test::ScratchFolder folder;
  const double first = 100.0 * std::numbers::pi;  // 3000 rpm
  WriteGearedPicture(folder / "g.svg", {At(first, 50.0), At(first, -25.0), At(2.0 * first, 100.0)});
  const std::string svg = test::Content(folder / "g.svg");
  EXPECT_EQ(test::Count(svg, "3000 rpm"), 2U);
  EXPECT_EQ(test::Count(svg, "6000 rpm"), 2U);
  EXPECT_GE(test::Count(svg, "pinion"), 1U);
}

TEST(GearedPicture, WithoutAPathIsNotWritten) {
  WriteGearedPicture("", {At(1.0, 1.0)});
  EXPECT_FALSE(std::filesystem::exists(""));
}

}  // namespace
}  // namespace levitas::cli
