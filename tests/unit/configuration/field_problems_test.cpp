// What is said about the value of one key: exact texts with line and column.
#include <gtest/gtest.h>

#include "tests/unit/configuration/samples.hpp"

namespace levitas::configuration::test {
namespace {

// Line 21 of the rig is "      gap_mm: 0.4"; its value begins in column 15.
std::string WithGap(const std::string& value) {
  return RigProblems(With(kRig, "gap_mm: 0.4", "gap_mm: " + value));
}

TEST(Samples, AreRight) {
  EXPECT_EQ(RigProblems(kRig), "");
  EXPECT_EQ(ControllerProblems(kController), "");
  EXPECT_EQ(ScenarioProblems(kScenario), "");
}

TEST(Number, OutOfRangeIsRefusedWithTheRange) {
  EXPECT_EQ(WithGap("70"),
            "rig.yaml:21:15: bearings[0].magnet.gap_mm: found 70 mm, allowed 0.02 to 10 mm");
  EXPECT_EQ(WithGap("-0.4"),
            "rig.yaml:21:15: bearings[0].magnet.gap_mm: found -0.4 mm, allowed 0.02 to 10 mm");
}

// The coils of the rig on a voltage instead of a current loop.
std::string WithVoltage(const std::string& more) {
  return RigProblems(
      With(kRig, "bandwidth_hz: 1000", "voltage: {time_constant_ms: 30, decay_mm: 5" + more + "}"));
}

// A further key of the probe.
std::string WithProbe(const std::string& more) {
  return RigProblems(With(kRig, "noise_rms_um: 1\n", "noise_rms_um: 1\n      " + more + "\n"));
}

TEST(Probe, TakesAFilterOfSecondOrderAndNoOther) {
  EXPECT_EQ(WithProbe("filter: butterworth_2"), "");
  EXPECT_EQ(WithProbe("filter: first_order"), "");
  EXPECT_NE(WithProbe("filter: bessel").find("bearings[0].sensor.filter"), std::string::npos);
}

TEST(Probe, TakesAMeasuredCurveThatAscendsThroughTheCentre) {
  const auto curve = [](const std::string& last) {
    return WithProbe(
        "characteristic: [{displacement_um: -100, reading_um: -90}, {displacement_um: 0, "
        "reading_um: 0}, {displacement_um: 100, reading_um: " +
        last + "}]");
  };
  EXPECT_EQ(curve("120"), "");
  EXPECT_NE(curve("-1").find("must both ascend"), std::string::npos);
  EXPECT_NE(WithProbe("characteristic: [{displacement_um: -100, reading_um: -90}, "
                      "{displacement_um: 100, reading_um: 120}]")
                .find("one point must be the centre"),
            std::string::npos);
}

TEST(Voltage, TakesWhatACoilCanDoAndRefusesTheRestKeyByKey) {
  EXPECT_EQ(WithVoltage(""), "");
  EXPECT_EQ(WithVoltage(", dead_band_ma: 90, curvature: -0.2, iron_1_per_a2: 0.2, "
                        "warming_1_per_s: 1e-3, away_steady_ratio: 0.9, "
                        "away_time_constant_ratio: 1.2"),
            "");
  const auto only = [](const std::string& key, const std::string& found) {
    const std::string problem = WithVoltage(", " + key + ": " + found);
    EXPECT_NE(problem.find("bearings[0].amplifier.voltage." + key + ": found " + found),
              std::string::npos)
        << problem;
    EXPECT_NE(problem.find("allowed"), std::string::npos) << problem;
    EXPECT_EQ(problem.find('\n'), std::string::npos) << "one error: " << problem;
  };
  only("dead_band_ma", "-1");
  only("curvature", "1.5");
  only("iron_1_per_a2", "-0.1");
  only("warming_1_per_s", "2");
  only("away_steady_ratio", "0");
  only("away_time_constant_ratio", "-1");
  EXPECT_EQ(
      WithVoltage(", dead_band_ma: 2000"),
      "rig.yaml:23:5: bearings[0].amplifier: dead band 2000 mA of the voltage must be smaller "
      "than max_current, 2000 mA, of which nothing would be left");
}

TEST(Number, AtTheBoundIsAllowedAndBeyondItIsNot) {
  // The clearance must stay below the gap, so the lower bound is tried on another key.
  EXPECT_EQ(WithGap("10"), "");
  EXPECT_NE(WithGap("10.000000000000002"), "");
  EXPECT_EQ(RigProblems(With(kRig, "poisson: 0.3", "poisson: 0")), "");
  EXPECT_NE(RigProblems(With(kRig, "poisson: 0.3", "poisson: -5e-324")), "");
}

TEST(Number, NotFiniteIsRefused) {
  for (const char* text : {".nan", "nan", "NaN", ".inf", "-.inf", "inf", "Infinity"}) {
    EXPECT_EQ(WithGap(text), std::string("rig.yaml:21:15: bearings[0].magnet.gap_mm: found \"") +
                                 text + "\", not a finite number; allowed 0.02 to 10 mm");
  }
  EXPECT_EQ(WithGap("1e999"),
            "rig.yaml:21:15: bearings[0].magnet.gap_mm: found \"1e999\", beyond what a double can "
            "hold; allowed 0.02 to 10 mm");
}

TEST(Number, OfTheWrongTypeIsRefusedWithTheReason) {
  const std::string at = "rig.yaml:21:15: bearings[0].magnet.gap_mm: found ";
  EXPECT_EQ(WithGap("wide"), at + "\"wide\", not a number; allowed 0.02 to 10 mm");
  EXPECT_EQ(WithGap("0,4"), at + "\"0,4\", the decimal sign is a point; allowed 0.02 to 10 mm");
  EXPECT_EQ(WithGap("0.4 mm"),
            at + "\"0.4 mm\", a number alone: its unit belongs in the key; allowed 0.02 to 10 mm");
  EXPECT_EQ(WithGap("\"0.4\""), at + "\"0.4\" in quotes, allowed 0.02 to 10 mm");
  EXPECT_EQ(WithGap("0x1"), at + "\"0x1\", not a number; allowed 0.02 to 10 mm");
  EXPECT_EQ(WithGap("[0.4]"), at + "a list, allowed 0.02 to 10 mm");
  EXPECT_EQ(WithGap("{a: 1}"), at + "a group of keys, allowed 0.02 to 10 mm");
  EXPECT_EQ(WithGap(""),
            "rig.yaml:21:7: bearings[0].magnet.gap_mm: found nothing, allowed 0.02 to 10 mm");
}

TEST(Number, TakesAnyUnitOfItsDimension) {
  const auto gap_m = [](const std::string& line) {
    return ParseRig(With(kRig, "gap_mm: 0.4", line), "").plant.bearings[0].magnet.gap_m;
  };
  EXPECT_EQ(gap_m("gap_um: 400"), 400e-6);
  EXPECT_EQ(gap_m("gap_m: 4e-4"), 400e-6);
  const RigFile rig = ParseRig(With(kRig, "max_speed_rpm: 6000", "max_speed_rad_per_s: 500"), "");
  EXPECT_EQ(rig.numbers.max_speed_rad_per_s, 500.0);
}

TEST(Number, InAnotherUnitIsRefusedWithTheRangeInThatUnit) {
  EXPECT_EQ(RigProblems(With(kRig, "gap_mm: 0.4", "gap_um: 0.4")),
            "rig.yaml:21:15: bearings[0].magnet.gap_um: found 0.4 um, allowed 20 to 10000 um");
}

TEST(Number, GivenInTwoUnitsIsRefused) {
  EXPECT_EQ(RigProblems(With(kRig, "gap_mm: 0.4", "gap_mm: 0.4\n      gap_um: 400")),
            "rig.yaml:22:7: bearings[0].magnet.gap_um: already given as gap_mm");
}

// YAML 1.1 reads 0144 as the octal number 100, YAML 1.2 as 144.
TEST(Number, WithAZeroInFrontIsRefusedForTwoStandardsReadItAsTwoNumbers) {
  EXPECT_EQ(
      WithGap("00.4"),
      "rig.yaml:21:15: bearings[0].magnet.gap_mm: found \"00.4\", not one number to all: with "
      "a zero in front it is octal to some programs; write 0.4; allowed 0.02 to 10 mm");
  for (const char* zeros : {"01", "+01", "0010", "-007"}) {
    EXPECT_NE(WithGap(zeros).find("octal to some programs"), std::string::npos) << zeros;
  }
  for (const char* plain : {"0.4", "4e-1", "+0.4", "0.4e00"}) EXPECT_EQ(WithGap(plain), "");
}

TEST(Integer, MustBeWholeAndInRange) {
  const auto problems = [](const std::string& value) {
    return RigProblems(With(kRig, "range_um: 300", "range_um: 300\n      adc_bits: " + value));
  };
  const std::string at = "rig.yaml:29:17: bearings[0].sensor.adc_bits: found ";
  EXPECT_EQ(problems("14"), "");
  EXPECT_EQ(problems("+14"), "");
  EXPECT_EQ(problems("25"), at + "25, allowed 0 to 24 (whole)");
  EXPECT_EQ(problems("99999999999999999999"), at + "99999999999999999999, allowed 0 to 24 (whole)");
  EXPECT_EQ(problems("14.5"), at + "\"14.5\", not a whole number; allowed 0 to 24 (whole)");
  EXPECT_EQ(problems("1e1"), at + "\"1e1\", not a whole number; allowed 0 to 24 (whole)");
  EXPECT_EQ(problems("many"), at + "\"many\", not a number; allowed 0 to 24 (whole)");
  EXPECT_EQ(problems(".nan"), at + "\".nan\", not a finite number; allowed 0 to 24 (whole)");
}

TEST(Name, HasLettersDigitsAndUnderscoresOnly) {
  const std::string allowed = ", allowed a name of 1 to 32 characters: a-z, 0-9, _";
  EXPECT_EQ(RigProblems(With(kRig, "name: small", "name: Large Rotor")),
            "rig.yaml:2:7: name: found \"Large Rotor\"" + allowed);
  EXPECT_EQ(RigProblems(With(kRig, "name: small", "name: " + std::string(33, 'a'))),
            "rig.yaml:2:7: name: found \"" + std::string(33, 'a') + "\"" + allowed);
  EXPECT_EQ(RigProblems(With(kRig, "name: small", "name: \"quoted_is_fine\"")), "");
}

TEST(Choice, NamesTheNearestWord) {
  EXPECT_EQ(
      ScenarioProblems(With(kScenario, "do: lift", "do: lfit")),
      "scenario.yaml:4:9: steps[0].do: found \"lfit\", allowed nothing, lift, spin, coast_down, "
      "land, emergency_stop, reset; nearest lift");
}

TEST(Choice, OfAChannelIsTheRigs) {
  const std::string excitation =
      "hold_s: 1\n    excitation:\n      - {channel: dex, amplitude_a: 0.1}";
  EXPECT_EQ(
      ScenarioProblems(With(kScenario, "hold_s: 1", excitation)),
      "scenario.yaml:9:19: steps[0].excitation[0].channel: found \"dex\", allowed de_x, de_y, all; "
      "nearest de_x");
}

// Before: one problem for each of the words.
TEST(Choice, OfTheChannelsOfAnotherRigIsOneProblemThatNamesThemAllAndTheRigs) {
  const std::string excitation =
      "hold_s: 1\n    excitation:\n      - {channel: lx, amplitude_a: 0.1}\n"
      "      - {channel: uy, amplitude_a: 0.1}\n      - {channel: lx, amplitude_a: 0.2}";
  EXPECT_EQ(
      ScenarioProblems(With(kScenario, "hold_s: 1", excitation)),
      "scenario.yaml:9:19: steps[0].excitation[0].channel: found \"lx\", \"uy\" in 3 places, "
      "first here; rig small has de_x, de_y, all. The file seems to be written for another rig: "
      "use it with that rig, or change these words");
}

TEST(Choice, OfAMisspeltChannelIsOneProblemHoweverOftenItIsWritten) {
  const std::string excitation =
      "hold_s: 1\n    excitation:\n      - {channel: dex, amplitude_a: 0.1}\n"
      "      - {channel: dex, amplitude_a: 0.2}";
  EXPECT_EQ(ScenarioProblems(With(kScenario, "hold_s: 1", excitation)),
            "scenario.yaml:9:19: steps[0].excitation[0].channel: found \"dex\" in 2 places, first "
            "here, allowed de_x, de_y, all; nearest de_x");
}

TEST(EveryProblem, IsListedInTheOrderOfTheFile) {
  std::string text = With(kRig, "period_us: 100", "period_us: 5");
  text = With(text, "poisson: 0.3", "poissson: 0.3");
  text = With(text, "friction: 0.15", "friction: a lot");
  EXPECT_EQ(
      RigProblems(text),
      "3 problems in rig.yaml:\n"
      "rig.yaml:4:14: sampling.period_us: found 5 us, allowed 10 to 10000 us\n"
      "rig.yaml:11:5: rotor.material.poissson: unknown key, nearest key poisson\n"
      "rig.yaml:33:17: bearings[0].touchdown.friction: found \"a lot\", not a number; allowed "
      "0 to 1");
}

}  // namespace
}  // namespace levitas::configuration::test
