// What is said about keys, groups and lists: exact texts with line and column.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/configuration/samples.hpp"

namespace levitas::configuration::test {
namespace {

TEST(UnknownKey, NamesTheNearestAndDoesNotReportTheRightOneAsMissing) {
  EXPECT_EQ(RigProblems(With(kRig, "gap_mm", "gapp_mm")),
            "rig.yaml:21:7: bearings[0].magnet.gapp_mm: unknown key, nearest key gap_mm");
}

TEST(UnknownKey, AHundredThousandOfThemAreOneProblem) {
  std::string text = kRig;
  for (int i = 0; i < 100'000; ++i) text += fmt::format("unknown_{}: 1\n", i);
  EXPECT_THAT(RigProblems(text), ::testing::HasSubstr("a group of more than 256 keys"));
}

TEST(UnknownKey, MoreThanFiftyAreCountedAndNotAllTold) {
  std::string text = kRig;
  for (int i = 0; i < 60; ++i) text += fmt::format("far_from_everything_{}: 1\n", i);
  const std::string problems = RigProblems(text);
  EXPECT_THAT(problems, ::testing::StartsWith("60 problems in rig.yaml:"));
  EXPECT_THAT(problems, ::testing::EndsWith("\nand 10 more"));
}

TEST(UnknownKey, FarFromAllListsTheKeysOfItsGroup) {
  EXPECT_EQ(RigProblems(With(kRig, "      bandwidth_hz: 1000\n",
                             "      bandwidth_hz: 1000\n      colour: red\n")),
            "rig.yaml:25:7: bearings[0].amplifier.colour: unknown key; known here: voltage, "
            "bandwidth_hz, "
            "slew_a_per_s, dac_bits, polarity_x, polarity_y");
}

TEST(UnknownKey, WithAWrongUnitIsToldTheRightOne) {
  EXPECT_EQ(RigProblems(With(kRig, "gap_mm: 0.4", "gap_mil: 15")),
            "rig.yaml:21:7: bearings[0].magnet.gap_mil: unknown key, nearest key gap_mm");
}

TEST(UnknownKey, IsFoundAtEveryLevel) {
  EXPECT_EQ(RigProblems(With(kRig, "drive:", "driv:")),
            "rig.yaml:35:1: driv: unknown key, nearest key drive");
  EXPECT_EQ(RigProblems(With(kRig, "    - length_mm: 200\n", "    - lenght_mm: 200\n")),
            "rig.yaml:14:7: rotor.sections[0].lenght_mm: unknown key, nearest key length_mm");
}

TEST(UnknownKey, ThatOnlyLacksItsUnitIsToldTheDocumentedOne) {
  EXPECT_EQ(RigProblems(With(kRig, "gap_mm: 0.4", "gap: 0.4")),
            "rig.yaml:21:7: bearings[0].magnet.gap: unknown key, nearest key gap_mm");
}

TEST(UnknownKey, WithAMicroSignIsToldTheUnitInLetters) {
  EXPECT_EQ(RigProblems(With(kRig, "range_um", "range_\xC2\xB5m")),
            "rig.yaml:28:7: bearings[0].sensor.range_\xC2\xB5m: unknown key, nearest key range_um");
}

TEST(UnknownKey, ThatSlippedOutOfItsGroupIsToldWhereItBelongs) {
  EXPECT_EQ(
      RigProblems(With(kRig, "    magnet:\n", "    gap_mm: 0.3\n    magnet:\n")),
      "rig.yaml:20:5: bearings[0].gap_mm: unknown key; known here: name, axis_names, axes, shaft, "
      "actuator_z_mm, "
      "sensor_z_mm, magnet, amplifier, sensor, touchdown; it belongs under bearings[0].magnet");
}

TEST(MissingKey, IsReportedAtItsGroupWithMeaningAndRange) {
  EXPECT_EQ(RigProblems(With(kRig, "      gap_mm: 0.4\n", "")),
            "rig.yaml:20:5: bearings[0].magnet.gap_mm: missing; radial air gap s0 with the rotor "
            "centred; allowed 0.02 to 10 mm");
}

TEST(MissingGroup, IsOneProblem) {
  EXPECT_EQ(RigProblems(With(kRig, "coils:\n  bias_current_a: 1\n  max_current_a: 2\n", "")),
            "rig.yaml:1:1: coils: missing; a group that must hold bias_current_a, max_current_a");
}

TEST(MissingGroup, IsFineWhenAllItsKeysHaveDefaults) {
  const RigFile rig = ParseRig(kRig, "");  // has no gravity
  EXPECT_EQ(rig.plant.gravity_m_per_s2, 9.81);
  const ControllerFile controller = ParseController(kController, "", rig.numbers);
  EXPECT_EQ(controller.supervisor.protection.orbit_fraction, 0.5);
}

TEST(Group, ThatIsANumberIsOneProblem) {
  EXPECT_EQ(
      RigProblems(With(kRig, "coils:\n  bias_current_a: 1\n  max_current_a: 2\n", "coils: 3\n")),
      "rig.yaml:5:1: coils: must hold keys of its own (name: value, indented)");
}

TEST(DuplicateKey, IsRefusedWithTheFirstLine) {
  EXPECT_EQ(RigProblems(With(kRig, "  poisson: 0.3", "  poisson: 0.3\n    poisson: 0.29")),
            "rig.yaml:12:5: rotor.material.poisson: given twice, first on line 11");
}

TEST(List, MustNotBeEmptyWhereOneIsNeeded) {
  EXPECT_EQ(ScenarioProblems("kind: scenario\nname: small\nsteps: []\n"),
            "scenario.yaml:3:1: steps: found an empty list, allowed 1 to 1000 items");
}

TEST(List, MustBeAList) {
  EXPECT_EQ(ScenarioProblems("kind: scenario\nname: small\nsteps: {do: lift}\n"),
            "scenario.yaml:3:1: steps: must be a list (lines that begin with -), allowed 1 to 1000 "
            "items");
  EXPECT_EQ(ScenarioProblems("kind: scenario\nname: small\nsteps:\n  - lift\n"),
            "scenario.yaml:4:5: steps[0]: must hold keys (- name: value)");
}

TEST(List, OfTooManyBearingsIsRefused) {
  std::string text(kRig);
  const std::size_t from = text.find("  - name: de");
  const std::string bearing = text.substr(from, text.find("drive:") - from);
  for (int i = 0; i < 4; ++i) text.insert(from, With(bearing, "de", fmt::format("b{}", i)));
  EXPECT_EQ(RigProblems(text), "rig.yaml:16:1: bearings: found 5 items, allowed 1 to 4 items");
}

TEST(MagnetStrength, IsGivenInExactlyOneWay) {
  const std::string ways =
      "force_constant_n_m2_per_a2; or ki_n_per_a; or turns, pole_area_mm2 and half_pole_angle_deg";
  EXPECT_EQ(
      RigProblems(With(kRig, "      ki_n_per_a: 40\n", "")),
      "rig.yaml:20:5: bearings[0].magnet: the strength of the magnet is missing; give " + ways);
  EXPECT_EQ(
      RigProblems(With(kRig, "ki_n_per_a: 40", "ki_n_per_a: 40\n      turns: 138")),
      "rig.yaml:23:7: bearings[0].magnet.turns: the strength of the magnet is given more than "
      "once; give " +
          ways);
}

TEST(MagnetStrength, OfACoilNeedsAllItsKeys) {
  EXPECT_EQ(
      RigProblems(With(kRig, "ki_n_per_a: 40", "turns: 138\n      pole_area_mm2: 470.3")),
      "rig.yaml:20:5: bearings[0].magnet.half_pole_angle_deg: missing; between a pole and the "
      "axis of its magnet; the gap is then that at the pole; allowed 0 to 80 deg");
}

TEST(Kind, MustBeTheOneAskedForAndIsTheOnlyProblemThen) {
  EXPECT_EQ(RigProblems(kController),
            "rig.yaml:1:7: kind: found \"controller\", but a rig file is needed here (kind: rig)");
  EXPECT_EQ(RigProblems(With(kRig, "kind: rig\n", "")),
            "rig.yaml:1:1: kind: missing; a rig file begins with `kind: rig`");
}

TEST(Text, ThatIsNoYamlIsOneProblemWithItsPlace) {
  const std::string problems = RigProblems(With(kRig, "poisson: 0.3", "poisson: [0.3"));
  EXPECT_EQ(problems.rfind("rig.yaml:12:", 0), 0U) << problems;
  EXPECT_NE(problems.find("not valid YAML"), std::string::npos);
  EXPECT_EQ(problems.find('\n'), std::string::npos);
}

TEST(Text, WithABrokenLineShowsItAndSaysWhatToLookFor) {
  const std::string problems = RigProblems(With(kRig, "gap_mm: 0.4", "gap_mm:0.4"));
  EXPECT_EQ(problems,
            "rig.yaml:22:17: not valid YAML: illegal map value near \"ki_n_per_a: 40\"; look here "
            "and at the line before: indent with spaces, not tabs, all keys of a group alike; a "
            "space after each colon; quotes and brackets closed");
}

TEST(Text, OfASecondDocumentIsRefused) {
  EXPECT_EQ(RigProblems(std::string(kRig) + "---\nkind: rig\n"),
            "rig.yaml:43:1: a second document begins here; one file holds one");
}

TEST(Text, ThatIsAListOrEmptyIsRefused) {
  EXPECT_EQ(RigProblems("- a\n"),
            "rig.yaml:1:1: the file must hold keys (name: value) at its first level");
  EXPECT_EQ(RigProblems(""), "rig.yaml:1:1: the file is empty");
}

TEST(ControllerLaws, OfAnUnknownBearingNameTheNearest) {
  EXPECT_EQ(
      ControllerProblems(With(kController, "  de:", "  dee:")),
      "2 problems in controller.yaml:\n"
      "controller.yaml:3:1: laws: no law for de_x, de_y; give one for each bearing or axis of "
      "the rig\n"
      "controller.yaml:4:3: laws.dee: unknown key, nearest key de");
}

TEST(ControllerLaws, MustCoverEveryAxis) {
  EXPECT_EQ(
      ControllerProblems(With(kController, "  de:", "  de_x:")),
      "controller.yaml:3:1: laws: no law for de_y; give one for each bearing or axis of the rig");
}

TEST(ControllerLaws, OfAnAxisReplaceTheBearings) {
  const std::string own =
      "  de_y: {kp_a_per_m: 1, ki_a_per_m_s: 2, kd_a_s_per_m: 3, derivative_corner_hz: 4}\n";
  const ControllerFile file = ParseController(kController + own, "", SmallRig());
  EXPECT_EQ(file.law.axes[0].kp_a_per_m, 5000.0);
  EXPECT_EQ(file.law.axes[1].kp_a_per_m, 1.0);
  EXPECT_TRUE(file.law.axes[1].notches.empty());
}

TEST(ScenarioStep, HasSpeedOnlyWithSpin) {
  EXPECT_EQ(ScenarioProblems(With(kScenario, "until: levitating", "speed_rpm: 100")),
            "2 problems in scenario.yaml:\n"
            "scenario.yaml:5:5: steps[0].speed_rpm: only allowed with do: spin\n"
            "scenario.yaml:6:5: steps[0].timeout_s: only allowed with an until");
}

TEST(ScenarioStep, NeedsASpeedWithSpinAndATimeOutWithUntil) {
  EXPECT_EQ(
      ScenarioProblems(With(kScenario, "    speed_rpm: 3000\n", "")),
      "scenario.yaml:8:5: steps[1].speed_rpm: missing; speed to reach; allowed 0 to 300000 rpm");
  EXPECT_EQ(
      ScenarioProblems(With(kScenario, "    timeout_s: 5\n", "")),
      "scenario.yaml:4:5: steps[0].timeout_s: missing; the scenario fails when the wait takes "
      "longer; allowed 0.001 to 100000 s");
}

}  // namespace
}  // namespace levitas::configuration::test
