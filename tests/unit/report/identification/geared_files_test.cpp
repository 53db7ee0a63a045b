#include "report/identification/geared_files.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/report/identification/written.hpp"

namespace levitas::report {
namespace {

using identification::GearedLine;
using identification::GearedParameters;
using identification::HalfSpectrum;
using identification::TorsionLine;

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

/// Two couplings, 1x of two speeds each. Of the first a stiffness is found and at the first speed
/// the model's torque is known; of the second neither.
HalfSpectrum TwoCouplings(double speed_rad_per_s) {
  HalfSpectrum half;
  half.couplings = {{"motor to pinion", 1830.0, 1900.0, 12.0, 2, 0.03},
                    {"gear to brake", 1470.0, 0.0, 0.0, 0, {}}};
  for (std::size_t coupling = 0; coupling < 2; ++coupling) {
    for (const double times : {1.0, 2.0}) {
      TorsionLine line{.coupling = coupling,
                       .name = "pinion_1x",
                       .speed_rad_per_s = times * speed_rad_per_s,
                       .frequency_rad_per_s = times * speed_rad_per_s,
                       .torque_n_m = std::polar(0.4 * times, -2.5),
                       .twist_rad = std::polar(2e-4 * times, -2.4),
                       .torque_sigma_n_m = 6e-5,
                       .twist_sigma_rad = 3e-8,
                       .model_n_m = {}};
      if (coupling == 0 && times == 1.0) line.model_n_m = std::polar(0.38, 1.25);
      half.lines.push_back(line);
    }
  }
  return half;
}

TEST(TorsionJson, HoldsTheLinesOfEachCouplingWithTheModelsAsAmplitudeAndPhase) {
  const auto json = TorsionJson(TwoCouplings(100.0 * std::numbers::pi));
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["coupling"], "motor to pinion");
  EXPECT_EQ(json[1]["coupling"], "gear to brake");
  EXPECT_EQ(json[0]["unexplained_share"], 0.03);
  EXPECT_TRUE(json[1]["unexplained_share"].is_null());
  ASSERT_EQ(json[0]["lines"].size(), 2U);
  ASSERT_EQ(json[1]["lines"].size(), 2U);
  const auto& line = json[0]["lines"][0];
  EXPECT_EQ(line["line"], "pinion_1x");
  EXPECT_NEAR(line["pinion_speed_hz"].get<double>(), 50.0, 1e-12);
  EXPECT_NEAR(line["frequency_hz"].get<double>(), 50.0, 1e-12);
  EXPECT_NEAR(line["torque_n_m"].get<double>(), 0.4, 1e-15);
  EXPECT_NEAR(line["torque_phase_rad"].get<double>(), -2.5, 1e-12);
  EXPECT_EQ(line["torque_sigma_n_m"], 6e-5);
  EXPECT_NEAR(line["twist_rad"].get<double>(), 2e-4, 1e-18);
  EXPECT_EQ(line["twist_sigma_rad"], 3e-8);
  EXPECT_NEAR(line["model_torque_n_m"].get<double>(), 0.38, 1e-15);
  EXPECT_NEAR(line["model_phase_rad"].get<double>(), 1.25, 1e-12);
}

TEST(TorsionJson, SaysNullWhereNoLineStandsOutAndWhereTheModelIsNotSeen) {
  const auto json = TorsionJson(TwoCouplings(314.0));
  EXPECT_EQ(json[0]["stiffness_n_m_per_rad"], 1900.0);
  EXPECT_EQ(json[0]["stiffness_sigma_n_m_per_rad"], 12.0);
  EXPECT_EQ(json[0]["known_n_m_per_rad"], 1830.0);
  for (const char* of : {"stiffness_n_m_per_rad", "stiffness_sigma_n_m_per_rad"}) {
    ASSERT_TRUE(json[1].contains(of));
    EXPECT_TRUE(json[1][of].is_null()) << of;
  }
  EXPECT_EQ(json[1]["known_n_m_per_rad"], 1470.0);
  for (const auto& unseen : {json[0]["lines"][1], json[1]["lines"][0], json[1]["lines"][1]}) {
    ASSERT_TRUE(unseen.contains("model_torque_n_m"));
    EXPECT_TRUE(unseen["model_torque_n_m"].is_null());
    EXPECT_TRUE(unseen["model_phase_rad"].is_null());
    EXPECT_TRUE(unseen["torque_n_m"].is_number());
  }
}

TEST(TorsionJson, IsAnEmptyListWithoutCouplings) { EXPECT_EQ(TorsionJson({}).dump(), "[]"); }

TEST(GearedPicture, HasAPanelOfTheTorqueOfEachCouplingAndNoneWithout) {
  const levitas::test::ScratchFolder folder;
  const double first = 100.0 * std::numbers::pi;  // 3000 rpm
  const std::vector<GearedLine> lines{At(first, 50.0), At(2.0 * first, 100.0)};
  WriteGearedPicture(folder / "without.svg", lines);
  WriteGearedPicture(folder / "with.svg", lines, TwoCouplings(first));
  const std::string without = test::Content(folder / "without.svg");
  const std::string with = test::Content(folder / "with.svg");
  EXPECT_EQ(test::Count(without, "torque"), 0U);
  EXPECT_EQ(test::Count(with, "torque, motor to pinion: measured and model"), 1U);
  EXPECT_EQ(test::Count(with, "torque, gear to brake: measured and model"), 1U);
  for (const char* speed : {"3000 rpm", "6000 rpm"}) {  // also of a coupling without a model
    EXPECT_EQ(test::Count(without, speed), 2U);
    EXPECT_EQ(test::Count(with, speed), 4U);
  }
}

TEST(GearedPicture, WithoutAPathIsNotWritten) {
  WriteGearedPicture("", {At(1.0, 1.0)});
  EXPECT_FALSE(std::filesystem::exists(""));
}

}  // namespace
}  // namespace levitas::report
