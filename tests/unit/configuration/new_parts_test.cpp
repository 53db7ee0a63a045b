// What the tables of given modes, state-space laws, signals and events refuse, and in which words.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"
#include "tests/unit/configuration/full_samples.hpp"

namespace levitas::configuration::test {
namespace {

using testing::HasSubstr;

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

template <class Parse>
std::string ProblemOf(Parse parse) {
  try {
    parse();
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "accepted";
}

std::string RigProblem(const std::string& text) {
  return ProblemOf([&] { (void)ParseRig(text, "rig.yaml"); });
}

std::string LawProblem(const std::string& from, const std::string& to) {
  const RigNumbers rig = ModalRig().numbers;
  const std::string text = WriteController(StateSpaceController(rig), rig);
  return ProblemOf([&] { (void)ParseController(Replaced(text, from, to), "c.yaml", rig); });
}

std::string ScenarioProblem(const std::string& step, const std::string& rest = "") {
  const std::string text =
      "kind: scenario\nname: s\nsteps:\n  - do: nothing\n    hold_s: 1\n" + step + rest;
  return ProblemOf([&] { (void)ParseScenario(text, "s.yaml", FullRig().numbers); });
}

std::string ExcitationProblem(const std::string& excitation) {
  return ScenarioProblem("    excitation:\n      - {channel: de_x, " + excitation + "}\n");
}

TEST(ModalRotor, ReplacesTheShaftAndDoesNotStandBesideIt) {
  const std::string modal = WriteRig(ModalRig());
  EXPECT_EQ(RigProblem(modal), "accepted");
  EXPECT_THAT(RigProblem(Replaced(modal, "  unbalance:", "  sections: []\n  unbalance:")),
              HasSubstr("rotor.sections: only allowed without modal"));
}

TEST(ModalRotor, RefusesInertiasOfNoBodyAndPointsThatDoNotAscend) {
  const std::string modal = WriteRig(ModalRig());
  EXPECT_THAT(RigProblem(Replaced(modal, "polar_inertia_kg_m2: 0.00", "polar_inertia_kg_m2: 9.00")),
              HasSubstr("no body has Ip greater than 2 It"));
  EXPECT_THAT(RigProblem(Replaced(modal, "- z_mm: 177", "- z_mm: 17")),
              HasSubstr("must be greater than that of the point before"));
}

TEST(ModalRotor, TakesEachGyroscopicEntryOfItsModesOnce) {
  constexpr const char* kFile = "gyroscopic: []";
  RigFile rig = ModalRig();
  rig.plant.rotor.given->gyroscopic.clear();
  const std::string modal = WriteRig(rig);
  const auto with = [&](const std::string& entries) {
    return RigProblem(Replaced(modal, kFile, "gyroscopic: [" + entries + "]"));
  };
  EXPECT_EQ(with("{row: 1, column: 0, ratio: -0.2}, {row: 1, column: 1, ratio: 0.1}"), "accepted");
  EXPECT_THAT(with("{row: 2, column: 0, ratio: 0.1}"), HasSubstr("found 2, but there are 1 modes"));
  EXPECT_THAT(with("{row: 1, column: 2, ratio: 0.1}"), HasSubstr("greater than row"));
  EXPECT_THAT(with("{row: 1, column: 0, ratio: 0.1}, {row: 1, column: 0, ratio: 0.2}"),
              HasSubstr("this entry has been given already"));
}

TEST(Bearings, OfOneAxisStandAlone) {
  const std::string modal = WriteRig(ModalRig());
  EXPECT_THAT(RigProblem(Replaced(modal, "axes: xy", "axes: x")),
              HasSubstr("axes: x is for a rig with one bearing only"));
}

TEST(StateSpaceLaw, StandsInsteadOfTheOtherLaw) {
  EXPECT_THAT(LawProblem("sequence:", "laws: {}\nsequence:"),
              HasSubstr("laws: only allowed without state_space"));
}

TEST(StateSpaceLaw, RefusesAStateThatGrowsWhereNothingShowsIt) {
  const RigNumbers rig = ModalRig().numbers;
  ControllerFile file = StateSpaceController(rig);
  file.law.state_space->discrete = false;
  law::ModalBlock block;
  block.pole_real = 500.0;
  block.first_input = {1.0};
  file.law.state_space->blocks.push_back(block);
  const std::size_t last = file.law.state_space->blocks.size() - 1;
  const auto problem = [&](const law::ModalBlock& hidden) {
    file.law.state_space->blocks.back() = hidden;
    return ProblemOf([&] { (void)ParseController(WriteController(file, rig), "c.yaml", rig); });
  };
  EXPECT_THAT(problem(block), HasSubstr("state_space.blocks[" + std::to_string(last) +
                                        "]: a pole at +500 1/s and 0 Hz does not decay, and no "
                                        "current shows it"));
  block.first_output = {0.0, 1.0};
  EXPECT_EQ(problem(block), "accepted");  // an unstable controller is a controller
  block.first_input = {};
  EXPECT_THAT(problem(block), HasSubstr("no position drives it"));
}

TEST(StateSpaceLaw, RefusesWhatCannotBe) {
  EXPECT_THAT(LawProblem("channel: ux", "channel: de_x"),
              HasSubstr("allowed ux, uy, lx, ly; nearest"));
  EXPECT_THAT(LawProblem("time: continuous", "time: discrete"),
              HasSubstr("only allowed with time: continuous"));
  EXPECT_THAT(LawProblem("turning_rad_per_s: 1593.095", "turning_rad_per_s: 0"),
              HasSubstr("a block with a real pole has one state only"));
  EXPECT_THAT(LawProblem("output: uy\n      input: uy", "output: ux\n      input: ux"),
              HasSubstr("this path has been given already"));
  EXPECT_THAT(LawProblem("input_v_per_mm: 25", "input_v_per_mm: 0"),
              HasSubstr("allowed 1e-6 to 1e6"));
}

TEST(Excitation, RefusesKeysOfAnotherSignalOrPoint) {
  EXPECT_THAT(ExcitationProblem("amplitude_a: 0.1, from_hz: 3"),
              HasSubstr("from_hz: only allowed with signal: stepped_sine, chirp or multisine"));
  EXPECT_THAT(ExcitationProblem("amplitude_um: 3"),
              HasSubstr("only allowed with point: measured_position"));
  EXPECT_THAT(ExcitationProblem("point: measured_position, amplitude_um: 190"),
              HasSubstr("must be smaller than the clearance, 190 um"));
  EXPECT_THAT(ExcitationProblem("signal: chirp, amplitude_a: 0.1, from_hz: 3, to_hz: 6000, "
                                "repeat_s: 1"),
              HasSubstr("beyond half the sampling frequency, 5000 Hz"));
  EXPECT_THAT(ExcitationProblem("amplitude_a: 0.1, order: 32"), HasSubstr("allowed 2 to 31"));
}

TEST(Excitation, IsLimitedToAThirdOfTheClearanceUnlessTheScenarioSaysOtherwise) {
  const RigNumbers rig = FullRig().numbers;
  EXPECT_DOUBLE_EQ(EventfulScenario(rig).steps[0].orbit_limit_m, 0.3 * 190e-6);
  EXPECT_THAT(ScenarioProblem("    orbit_limit_um: 190\n    excitation:\n"
                              "      - {channel: de_x, amplitude_a: 0.1}\n"),
              HasSubstr("orbit_limit_um: must be smaller than the clearance"));
}

TEST(RigEvents, RefuseKeysThatDoNotGoWithThem) {
  const auto problem = [](const std::string& event) {
    return ScenarioProblem("", "rig_events:\n  - {at_s: 1, what: " + event + "}\n");
  };
  EXPECT_EQ(problem("sensor_frozen, channel: de_x"), "accepted");
  EXPECT_THAT(problem("sensor_frozen"), HasSubstr("channel: missing"));
  EXPECT_THAT(problem("emergency_stop, channel: de_x"),
              HasSubstr("only allowed with a fault of a sensor"));
  EXPECT_THAT(problem("effect, effect: unbalance, strength: 1, duration_s: 1"),
              HasSubstr("only allowed with a fault"));
  EXPECT_EQ(problem("torque, inertia: brake, torque_n_m: 5, duration_s: 0.1, ramp_s: 0.01"),
            "accepted");
  EXPECT_THAT(problem("torque, torque_n_m: 5"), HasSubstr("inertia: missing"));
  EXPECT_THAT(problem("torque, inertia: brake"), HasSubstr("torque_n_m: missing"));
  EXPECT_THAT(problem("torque, inertia: brake, torque_n_m: 5, strength: 1"),
              HasSubstr("only allowed with what: effect"));
  EXPECT_THAT(problem("sensor_dead, channel: de_x"), HasSubstr("nearest sensor_"));
}

TEST(Spin, WithoutAnAccelerationIsAStepAsFastAsTheDriveCan) {
  const auto scenario =
      ParseScenario("kind: scenario\nname: s\nsteps:\n  - {do: spin, speed_rpm: 100}\n", "s.yaml",
                    FullRig().numbers);
  const double most = FullRig().plant.drive.max_acceleration_rad_per_s2;
  EXPECT_NEAR(scenario.steps[0].acceleration_rad_per_s2 / most, 1.0, 1e-12);  // rounding
}

TEST(Spin, FasterThanTheDriveCanIsRefusedNotShortened) {
  const auto problem = [](double rpm_per_s) {
    const std::string text =
        "kind: scenario\nname: s\nsteps:\n  - {do: spin, speed_rpm: 100, acceleration_rpm_per_s: " +
        std::to_string(rpm_per_s) + "}\n";
    return ProblemOf([&] { (void)ParseScenario(text, "s.yaml", FullRig().numbers); });
  };
  const double most = RadPerSToRpm(FullRig().plant.drive.max_acceleration_rad_per_s2);
  EXPECT_THAT(problem(1.001 * most), HasSubstr("steps[0].acceleration_rpm_per_s: found"));
  EXPECT_THAT(problem(1.001 * most), HasSubstr("the rig's drive does"));
  EXPECT_EQ(problem(0.999 * most), "accepted");
}

}  // namespace
}  // namespace levitas::configuration::test
