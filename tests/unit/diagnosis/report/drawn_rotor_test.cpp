// The rotor of a report and the places on it, against the shipped rig files.

#include "diagnosis/report/drawn_rotor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

DiagnosisResult AnswerOn(const configuration::RigFile& rig) {
  DiagnosisResult answer;
  answer.view = std::make_shared<const RigView>(rig.numbers, rig.plant);
  return answer;
}

DiagnosisResult AnswerOn(const std::string& name) {
  return AnswerOn(configuration::LoadRig(configuration::FindConfig(name, "rigs")));
}

NamedParameter OfEffect(const std::string& effect, Location at, const std::string& key = "ratio") {
  NamedParameter p;
  p.effect = effect;
  p.location = std::move(at);
  p.key = key;
  return p;
}

TEST(ScaleOf, IsTheMassOfTheDrawingTheRatedSpeedAndTheNarrowestClearance) {
  configuration::RigFile rig = FlexibleRotor();
  rig.plant.bearings[1].touchdown.clearance_m = 150e-6;
  const ReportScale scale = ScaleOf(AnswerOn(rig));
  constexpr double kShaftKg = 7930.0 * std::numbers::pi / 4.0 * 9.525e-3 * 9.525e-3 * 0.4572;
  // The mass matrix of a uniform beam is exact: sums of some fifty elements round.
  EXPECT_NEAR(scale.rotor_mass_kg, kShaftKg + 0.6363 + 0.8021 + 0.6363, 1e-9);
  EXPECT_NEAR(scale.rated_speed_rad_per_s, 6000.0 * 2.0 * std::numbers::pi / 60.0, 1e-9);
  EXPECT_EQ(scale.clearance_m, 150e-6);
}

// A disc is as large as a solid one of its inertia and a hundredth of the shaft thick.
TEST(RotorOf, IsTheShaftWithThinDiscsOfTheirInertia) {
  const ReportRotor rotor = RotorOf(AnswerOn(FlexibleRotor()));
  ASSERT_EQ(rotor.pieces.size(), 4U);
  const ReportRotor::Piece& shaft = rotor.pieces[0];
  EXPECT_EQ(shaft.from_m, 0.0);
  EXPECT_DOUBLE_EQ(shaft.to_m, 0.4572);
  EXPECT_DOUBLE_EQ(shaft.outer_m, 9.525e-3);
  EXPECT_FALSE(shaft.disc);
  const ReportRotor::Piece& disc = rotor.pieces[2];
  EXPECT_TRUE(disc.disc);
  EXPECT_DOUBLE_EQ(0.5 * (disc.from_m + disc.to_m), 0.2992);
  EXPECT_NEAR(disc.to_m - disc.from_m, 4.572e-3, 1e-12) << "a difference of numbers near 0.3";
  EXPECT_DOUBLE_EQ(disc.outer_m, std::sqrt(8.0 * 2.40e-4 / 0.8021));
  ASSERT_EQ(rotor.bearings.size(), 2U);
  EXPECT_EQ(rotor.bearings[1].name, "nde");
  EXPECT_DOUBLE_EQ(rotor.bearings[1].magnet_z_m, 0.3996);
  EXPECT_DOUBLE_EQ(rotor.bearings[1].sensor_z_m, 0.4196);
}

TEST(RotorOf, HasRingsOfTheirOwnWidthAndNoneOfGearedShafts) {
  const ReportRotor rotor = RotorOf(AnswerOn("ufu_rig"));
  const auto ring = std::find_if(rotor.pieces.begin(), rotor.pieces.end(),
                                 [](const ReportRotor::Piece& piece) { return piece.disc; });
  ASSERT_NE(ring, rotor.pieces.end());
  // The first of the file: 8.8 mm wide about 112 mm, 34.8 to 49.8 mm in diameter.
  EXPECT_NEAR(ring->from_m, 0.1076, 1e-12);
  EXPECT_NEAR(ring->to_m, 0.1164, 1e-12);
  EXPECT_DOUBLE_EQ(ring->inner_m, 34.8e-3);
  EXPECT_DOUBLE_EQ(ring->outer_m, 49.8e-3);
  EXPECT_TRUE(RotorOf(AnswerOn("geared_rotor_4dof")).pieces.empty());
}

TEST(MarksOf, StandAtThePlaneTheMagnetOrTheSensorOfACauseOnceEach) {
  const DiagnosisResult answer = AnswerOn(FlexibleRotor());
  const RigNumbers& rig = FlexibleRotor().numbers;
  NamedParameter plane = OfEffect("unbalance", AtPlane(0.1), "z_mm");
  plane.value = 299.2;
  plane.si = 1e-3;
  const std::vector<ReportMark> marks = MarksOf(
      answer,
      {plane, OfEffect("unbalance", AtPlane(0.1), "moment_g_mm"),
       OfEffect("current_gain", AtAxis(rig, 1)), OfEffect("sensor_gain", AtAxis(rig, 2)),
       OfEffect("sensor_gain", AtAxis(rig, 3)), OfEffect("axis_rotation", AtSide(rig, 0, true))});
  ASSERT_EQ(marks.size(), 4U);
  EXPECT_DOUBLE_EQ(marks[0].z_m, 0.2992) << "as the entry says, not its term";
  EXPECT_EQ(marks[0].text, "unbalance");
  EXPECT_DOUBLE_EQ(marks[1].z_m, 0.1299) << "magnet de";
  EXPECT_DOUBLE_EQ(marks[2].z_m, 0.4196) << "sensor nde, x and y alike";
  EXPECT_EQ(marks[2].text, "sensor_gain");
  EXPECT_DOUBLE_EQ(marks[3].z_m, 0.1099) << "a rotation of the probes";
}

TEST(MarksOf, OfACauseOfTheWholeRigOrOnGearedShaftsAreNone) {
  EXPECT_TRUE(
      MarksOf(AnswerOn(FlexibleRotor()), {OfEffect("rotor_mass", Everywhere("rotor"))}).empty());
  EXPECT_TRUE(
      MarksOf(AnswerOn("geared_rotor_4dof"), {OfEffect("unbalance", AtPlane(0.1))}).empty());
}

}  // namespace
}  // namespace levitas::diagnosis
