// Relations between fields: each is broken once, and once only just kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/configuration/samples.hpp"

namespace levitas::configuration::test {
namespace {

TEST(CoilLimit, MustExceedTheBias) {
  EXPECT_EQ(
      RigProblems(With(kRig, "max_current_a: 2", "max_current_a: 1")),
      "rig.yaml:7:18: coils.max_current_a: found 1 A, but it must exceed the bias current 1 A");
  EXPECT_EQ(RigProblems(With(kRig, "max_current_a: 2", "max_current_a: 1.001")), "");
}

TEST(Planes, MustLieOnTheShaft) {
  EXPECT_EQ(RigProblems(With(kRig, "actuator_z_mm: 100", "actuator_z_mm: 200.1")),
            "rig.yaml:18:20: bearings[0].actuator_z_mm: beyond the end of the shaft (200 mm)");
  EXPECT_EQ(RigProblems(With(kRig, "sensor_z_mm: 110", "sensor_z_mm: 300")),
            "rig.yaml:19:18: bearings[0].sensor_z_mm: beyond the end of the shaft (200 mm)");
  EXPECT_EQ(RigProblems(With(kRig, "sensor_z_mm: 110", "sensor_z_mm: 200")), "");
}

TEST(Planes, AreNotJudgedByAShaftThatIsItselfRefused) {
  EXPECT_EQ(RigProblems(With(kRig, "length_mm: 200", "length_mm: 0")),
            "rig.yaml:14:18: rotor.sections[0].length_mm: found 0 mm, allowed 0.01 to 20000 mm");
}

TEST(Discs, MustLieOnTheShaftAndBePossibleBodies) {
  const auto with_disc = [](const std::string& disc) {
    return RigProblems(With(kRig, "bearings:", "  discs:\n    - {" + disc + "}\nbearings:"));
  };
  EXPECT_EQ(with_disc("z_mm: 201, mass_kg: 1, diametral_inertia_kg_m2: 1, polar_inertia_kg_m2: 1"),
            "rig.yaml:17:14: rotor.discs[0].z_mm: beyond the end of the shaft (200 mm)");
  EXPECT_EQ(with_disc("z_mm: 1, mass_kg: 1, diametral_inertia_kg_m2: 1, polar_inertia_kg_m2: 2.1"),
            "rig.yaml:17:78: rotor.discs[0].polar_inertia_kg_m2: no body has Ip greater than 2 Id");
  EXPECT_EQ(with_disc("z_mm: 1, mass_kg: 1, diametral_inertia_kg_m2: 1, polar_inertia_kg_m2: 2"),
            "");
}

TEST(Bore, MustBeSmallerThanTheOutside) {
  EXPECT_EQ(
      RigProblems(With(kRig, "outer_diameter_mm: 20",
                       "outer_diameter_mm: 20\n      inner_diameter_mm: 20")),
      "rig.yaml:16:26: rotor.sections[0].inner_diameter_mm: the bore must be smaller than the "
      "outer diameter");
}

TEST(Notch, StandsByTustinsRuleUnlessTheFileAsksForPrewarp) {
  const RigNumbers numbers = ParseRig(kRig, "rig.yaml").numbers;
  const auto notch = [&](const std::string& text) {
    return ParseController(text, "controller.yaml", numbers).law.axes[0].notches[0];
  };
  EXPECT_FALSE(notch(kController).prewarp);
  const std::string key = "pole_damping: 0.8\n        prewarp: ";
  EXPECT_TRUE(notch(With(kController, "pole_damping: 0.8", key + "true")).prewarp);
  EXPECT_FALSE(notch(With(kController, "pole_damping: 0.8", key + "false")).prewarp);
  EXPECT_THAT(ControllerProblems(With(kController, "pole_damping: 0.8", key + "yes")),
              ::testing::HasSubstr("nearest true"));
}

TEST(SensorRange, MustCoverTheClearance) {
  EXPECT_EQ(RigProblems(With(kRig, "range_um: 300", "range_um: 199")),
            "rig.yaml:25:5: bearings[0].sensor: sensor range 199 um is smaller than the touchdown "
            "clearance 200 um");
  EXPECT_EQ(RigProblems(With(kRig, "range_um: 300", "range_um: 200")), "");
}

TEST(Clearance, MustBeSmallerThanTheAirGap) {
  std::string text = With(kRig, "range_um: 300", "range_um: 500");
  EXPECT_EQ(
      RigProblems(With(text, "clearance_um: 200", "clearance_um: 400")),
      "rig.yaml:29:5: bearings[0].touchdown: clearance 400 um must be smaller than the air gap "
      "400 um");
}

TEST(BearingNames, MustDiffer) {
  std::string text(kRig);
  const std::size_t from = text.find("  - name: de");
  const std::string bearing = text.substr(from, text.find("drive:") - from);
  EXPECT_EQ(RigProblems(text.insert(from, bearing)),
            "rig.yaml:35:11: bearings[1].name: found \"de\", which an earlier bearing has");
}

TEST(Polarity, IsOneOrMinusOne) {
  EXPECT_EQ(RigProblems(With(kRig, "range_um: 300", "range_um: 300\n      polarity_x: 0")),
            "rig.yaml:29:19: bearings[0].sensor.polarity_x: found 0, allowed -1 or 1");
  const RigFile rig =
      ParseRig(With(kRig, "range_um: 300", "range_um: 300\n      polarity_y: -1"), "");
  EXPECT_EQ(rig.numbers.sensor_polarity[0], 1.0);
  EXPECT_EQ(rig.numbers.sensor_polarity[1], -1.0);
  EXPECT_EQ(rig.plant.actuator_polarity[1], 1.0);
}

TEST(Period, IsAWholeNumberOfNanoseconds) {
  EXPECT_EQ(RigProblems(With(kRig, "period_us: 100", "period_us: 62.5")), "");
  EXPECT_EQ(RigProblems(With(kRig, "period_us: 100", "period_us: 33.3333")),
            "rig.yaml:4:14: sampling.period_us: must be a whole number of nanoseconds");
}

TEST(Modes, AreNotMoreThanTheElementsHave) {
  const auto problems = [](const std::string& lines) {
    return RigProblems(With(kRig, "bearings:", lines + "bearings:"));
  };
  EXPECT_EQ(problems("  modes_per_plane: 1\n"),
            "rig.yaml:16:20: rotor.modes_per_plane: found 1, but a rotor has two rigid modes per "
            "plane: allowed 0 or 2 to 100");
  // 200 mm in pieces of at most 100 mm: 2 elements, 3 nodes, 6 degrees of freedom.
  EXPECT_EQ(problems("  max_element_length_mm: 100\n  modes_per_plane: 7\n"),
            "rig.yaml:17:20: rotor.modes_per_plane: more than the 6 that 2 finite elements have");
  EXPECT_EQ(problems("  max_element_length_mm: 100\n  modes_per_plane: 6\n"), "");
}

TEST(Elements, AreNotSoManyThatTheyFillTheMemory) {
  EXPECT_EQ(RigProblems(With(kRig, "bearings:", "  max_element_length_mm: 0.1\nbearings:")),
            "rig.yaml:16:26: rotor.max_element_length_mm: divides the shaft into 2000 finite "
            "elements, allowed 1 to 1000");
}

TEST(ForceConstant, ThatFollowsMustBeSensibleToo) {
  const std::string problems =
      RigProblems(With(kRig, "ki_n_per_a: 40",
                       "turns: 10000\n      pole_area_mm2: 1e6\n      half_pole_angle_deg: 0"));
  EXPECT_EQ(problems,
            "rig.yaml:20:5: bearings[0].magnet: gives a force constant of 31.42 N m^2/A^2, allowed "
            "1e-09 to 0.01");  // mu0 1e8 x 1 m^2 / 4 = 10 pi
}

TEST(Filters, LieBelowHalfTheSamplingFrequency) {
  EXPECT_EQ(ControllerProblems(
                With(kController, "derivative_corner_hz: 1800", "derivative_corner_hz: 5000")),
            "controller.yaml:8:27: laws.de.derivative_corner_hz: found 5000 Hz, allowed below half "
            "the sampling frequency, 5000 Hz");
  EXPECT_EQ(ControllerProblems(
                With(kController, "derivative_corner_hz: 1800", "derivative_corner_hz: 4999")),
            "");
  EXPECT_EQ(
      ControllerProblems(With(kController, "pole_hz: 1800", "pole_hz: 6000")),
      "controller.yaml:11:18: laws.de.lead_lags[0].pole_hz: found 6000 Hz, allowed below half "
      "the sampling frequency, 5000 Hz");
  EXPECT_EQ(ControllerProblems(With(kController, "frequency_hz: 450", "frequency_hz: 9000")),
            "controller.yaml:13:23: laws.de.notches[0].frequency_hz: found 9000 Hz, allowed below "
            "half the sampling frequency, 5000 Hz");
}

TEST(Filters, FollowTheRigsPeriod) {
  const RigNumbers slow = ParseRig(With(kRig, "period_us: 100", "period_us: 400"), "").numbers;
  EXPECT_THROW((void)ParseController(kController, "", slow), BadInput);  // 1800 Hz against 1250 Hz
}

TEST(NotchPoles, MustBeDamped) {
  EXPECT_EQ(ControllerProblems(With(kController, "pole_damping: 0.8", "pole_damping: 0")),
            "controller.yaml:15:23: laws.de.notches[0].pole_damping: found 0, allowed 0.001 to 10");
}

TEST(LiftTimeout, MustLeaveTimeForTheLift) {
  const std::string text = std::string(kController) + "sequence:\n  lift_timeout_s: 0.7\n";
  EXPECT_EQ(ControllerProblems(text),
            "controller.yaml:17:19: sequence.lift_timeout_s: found 0.7 s, but ramp and settling "
            "alone take 0.7 s");
}

TEST(DeadlineWindow, MustHoldTheMissesThatTrip) {
  const std::string text =
      std::string(kController) + "protection:\n  deadline_missed_cycles: 1001\n";
  EXPECT_EQ(ControllerProblems(text),
            "controller.yaml:17:27: protection.deadline_missed_cycles: more than the window holds: "
            "it could never trip");
}

TEST(CurrentLimit, IsWhatKeepsBothCoilsInRange) {
  RigNumbers rig = SmallRig();
  EXPECT_EQ(ParseController(kController, "", rig).law.current_limit_a, 1.0);
  rig.max_coil_current_a = 1.25;  // i0 + ic <= 1.25 A binds before i0 - ic >= 0
  EXPECT_EQ(ParseController(kController, "", rig).law.current_limit_a, 0.25);
}

TEST(ScenarioSpeed, StaysWithinTheRigsRatedSpeed) {
  EXPECT_EQ(ScenarioProblems(With(kScenario, "speed_rpm: 3000", "speed_rpm: 6001")),
            "scenario.yaml:9:16: steps[1].speed_rpm: found 6001 rpm, but the rig is rated for 6000 "
            "rpm");
  EXPECT_EQ(ScenarioProblems(With(kScenario, "speed_rpm: 3000", "speed_rpm: 6000")), "");
}

TEST(ScenarioWait, ForASpeedNeedsASpeed) {
  EXPECT_EQ(ScenarioProblems(With(kScenario, "until: levitating", "until: speed_reached")),
            "scenario.yaml:5:12: steps[0].until: speed_reached is only allowed with do: spin");
}

TEST(Excitation, NeedsAHoldTimeAndRoomInTheCoils) {
  const std::string base =
      "timeout_s: 6\n    excitation:\n      - {channel: de_x, amplitude_a: 0.1}";
  EXPECT_EQ(
      ScenarioProblems(With(kScenario, "timeout_s: 6", base)),
      "scenario.yaml:8:5: steps[1].hold_s: an excitation acts during the hold time, which is 0");
  EXPECT_EQ(ScenarioProblems(With(kScenario, "timeout_s: 6", "hold_s: 1\n    " + base)), "");
  EXPECT_EQ(ScenarioProblems(
                With(kScenario, "timeout_s: 6", "hold_s: 1\n    " + With(base, "0.1", "1.5"))),
            "scenario.yaml:15:38: steps[1].excitation[0].amplitude_a: found 1.5 A, but the coils "
            "leave 1 A in all");
}

TEST(ARefusedField, DoesNotCauseFurtherProblemsWithItsRelatives) {
  EXPECT_EQ(RigProblems(With(kRig, "clearance_um: 200", "clearance_um: .nan")),
            "rig.yaml:30:21: bearings[0].touchdown.clearance_um: found \".nan\", not a finite "
            "number; allowed 1 to 20000 um");
  EXPECT_EQ(RigProblems(With(kRig, "bias_current_a: 1", "bias_current_a: 1000")),
            "rig.yaml:6:19: coils.bias_current_a: found 1000 A, allowed 0.01 to 100 A");
}

}  // namespace
}  // namespace levitas::configuration::test
