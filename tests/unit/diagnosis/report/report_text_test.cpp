// Sentences, parameters and places of a report.

#include "diagnosis/report/report_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "configuration/rig_file.hpp"
#include "diagnosis/report/affected_part.hpp"
#include "diagnosis/report/build_report.hpp"
#include "diagnosis/report/excitation_coverage.hpp"
#include "diagnosis/report/named_values.hpp"
#include "diagnosis/report/plan.hpp"
#include "diagnosis/report/validation_check.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(ParametersTest, OfAHarmonicAreItsAmplitudeAndItsPhase) {
  const auto parameters = Parameters(Found(effect::Id::kUnbalance, "z 299.2 mm"));
  ASSERT_EQ(parameters.size(), 2U);
  for (const NamedParameter& p : parameters) {
    EXPECT_LT(p.low, p.value);
    EXPECT_GT(p.high, p.value);
    const bool phase = p.unit == "deg";
    EXPECT_EQ(p.key, phase ? "phase_deg" : "moment_g_mm");
    EXPECT_NEAR(p.value, phase ? 45.0 : std::sqrt(2.0) * 10.0, 1e-9);
    EXPECT_NEAR(p.value * p.si, phase ? std::atan2(1.0, 1.0) : std::sqrt(2.0) * 10e-6, 1e-9);
  }
}

TEST(ParametersTest, OfAnUnbalanceSayWhatItMakesWithTheOneOfTheFile) {
  const DiagnosisResult found = Found(effect::Id::kUnbalance, "z 299.2 mm");
  // The file has 18 g mm at 0 there, the cause 10 along x and 10 along y: 28 and 10.
  for (const NamedParameter& p : Parameters(found)) {
    ASSERT_TRUE(p.of_file.has_value()) << p.key;
    const bool phase = p.key == "phase_deg";
    EXPECT_NEAR(p.of_file->nominal, phase ? 0.0 : 18.0, 1e-9);
    EXPECT_NEAR(p.of_file->total, phase ? 19.6538 : 29.7321, 1e-3);
  }
  EXPECT_THAT(
      TotalSentences(Parameters(found)),
      ElementsAre(AllOf(HasSubstr("14.14 g mm at 45.0 deg is added to the 18 g mm at 0.0 deg"),
                        HasSubstr("in all 29.73 g mm at 19.7 deg"))));
  EXPECT_THAT(TotalSentences(Parameters(Found(effect::Id::kEddyCurrent, "de_x"))), IsEmpty());
}

TEST(ParametersTest, OfADelaySayWhatItMakesWithTheOneOfTheFile) {
  const DiagnosisResult found = Found(effect::Id::kExtraDelay, "all axes");
  for (const NamedParameter& p : Parameters(found)) {
    ASSERT_TRUE(p.of_file.has_value()) << p.key;
    EXPECT_NEAR(p.of_file->nominal, 100.0, 1e-9);  // one period of 10 kHz
    EXPECT_NEAR(p.of_file->total, 100.0 + p.value, 1e-9);
  }
  EXPECT_EQ(TotalSentences(Parameters(found)).size(), 1U);
}

TEST(CalibratedValues, SayWhichOfThemACauseHasTaken) {
  EXPECT_THAT(TakenByCauses(Found(effect::Id::kUnbalance, "z 299.2 mm")),
              ElementsAre("unbalance z 299.2 mm"));
  EXPECT_THAT(TakenByCauses(Found(effect::Id::kEddyCurrent, "de_x")), IsEmpty());
  EXPECT_THAT(TakenByCauses(NothingFound()), IsEmpty());
}

TEST(ParametersTest, OfAnEddyCurrentAreItsTimeConstant) {
  const auto parameters = Parameters(Found(effect::Id::kEddyCurrent, "de_x"));
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_EQ(parameters[0].name, "tau_us[de_x]");
  EXPECT_EQ(parameters[0].unit, "us");
  EXPECT_NEAR(parameters[0].value, 1e6 * std::pow(2.5e-3, 2), 1e-9);
  // The root is known to 0.25e-3: 1.645 of it to either side, squared.
  EXPECT_NEAR(parameters[0].low, 1e6 * std::pow(2.5e-3 - 1.645 * 0.25e-3, 2), 1e-9);
  EXPECT_NEAR(parameters[0].high, 1e6 * std::pow(2.5e-3 + 1.645 * 0.25e-3, 2), 1e-9);
}

TEST(ParametersTest, OfEveryEffectHaveTheKeysOfTheCatalogueInTheUnitsOfAFile) {
  const DiagnosisResult nothing = NothingFound();
  for (const Hypothesis& h : MakeHypotheses(*nothing.view, nothing.terms)) {
    const effect::Row& row = effect::At(h.effect);
    const auto parameters = Parameters(Found(h.effect, h.place));
    EXPECT_FALSE(parameters.empty()) << effect::At(h.effect).name << " at " << h.place;
    for (const NamedParameter& p : parameters) {
      // Angles may be given in any unit of angle.
      const bool in_catalogue = std::any_of(
          row.parameters.begin(), row.parameters.end(), [&p](const effect::Parameter& known) {
            const std::string stem(known.stem);
            return p.key == stem || p.key == stem + "_" + std::string(known.file_suffix);
          });
      EXPECT_TRUE(in_catalogue) << row.name << " " << p.key;
      EXPECT_LE(p.low, p.value) << row.name << " " << p.key;
      EXPECT_GE(p.high, p.value) << row.name << " " << p.key;
      EXPECT_LT(p.low, p.high) << row.name << " " << p.key;
    }
  }
}

TEST(ParametersTest, SayOfALawsFormThatItsBracketIsNoInterval) {
  for (const NamedParameter& p : Parameters(Found(effect::Id::kAmplifierSlew, "1500 A/s"))) {
    EXPECT_EQ(p.key, "slew_a_per_s");
    EXPECT_TRUE(p.form);
    // The neighbouring members lie 0.4 to either side in the logarithm.
    EXPECT_NEAR(p.low, 1500.0 * std::exp(-0.4), 1.0);
    EXPECT_NEAR(p.high, 1500.0 * std::exp(0.4), 1.0);
  }
}

TEST(ParametersTest, OfAGainAreTheFactorOnTheNominalValue) {
  const auto parameters = Parameters(Found(effect::Id::kCurrentGain, "nde_x"));
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_NEAR(parameters[0].value, 1.075, 1e-12);
}

TEST(PlaceTest, OfEveryTermOfEveryKindOfRigIsThatOfTheCatalogue) {
  for (const char* name : {"flexible_rotor", "geared_rotor_4dof", "turbomolecular_pump"}) {
    const auto rig = configuration::LoadRig(configuration::FindConfig(name, "rigs"));
    const RigView view(rig.numbers, rig.plant);
    for (const Term& term : AllTerms(view, Tolerances{}, 50e-6)) {
      if (!term.effect) continue;
      EXPECT_EQ(PlaceOfEffect(*term.effect), effect::Name(effect::At(*term.effect).place))
          << term.effect_name();
    }
  }
  EXPECT_EQ(PlaceOfEffect(effect::Id::kCurrentGain), "amplifier");
  EXPECT_EQ(PlaceOfEffect(effect::Id::kToothCrack), "gear");
}

TEST(PlaceTest, OfARotatedAxisIsWhereItsFrameIsRotated) {
  EXPECT_EQ(PlaceOf(Found(effect::Id::kAxisRotation, "sensor de")), "sensor");
  EXPECT_EQ(PlaceOf(Found(effect::Id::kAxisRotation, "magnet de")), "magnet");
  EXPECT_EQ(PlaceOf(NothingFound()), "");
}

TEST(PlaceTest, OfAnUnknownIsThatOfWhatItFollows) {
  DiagnosisResult s = NothingFound();
  s.answer.verdict = Verdict::kUnknown;
  s.answer.residual.coherent_with = "current";
  EXPECT_EQ(PlaceOf(s), "magnet");
  s.answer.residual.coherent_with = "rotation";
  EXPECT_EQ(PlaceOf(s), "rotor");
  s.answer.residual.coherent_with = "nothing";
  EXPECT_EQ(PlaceOf(s), "external");
}

TEST(ChannelsTest, AreThoseOfTheCause) {
  EXPECT_THAT(Channels(Found(effect::Id::kCurrentGain, "nde_x")), ElementsAre("nde_x"));
  EXPECT_THAT(Channels(Found(effect::Id::kCurrentGain, "de")), ElementsAre("de_x", "de_y"));
  EXPECT_THAT(Channels(Found(effect::Id::kSensorRunout, "order 2, de_y")), ElementsAre("de_y"));
  EXPECT_EQ(Channels(Found(effect::Id::kUnbalance, "z 299.2 mm")).size(), 4U);
  EXPECT_THAT(Channels(NothingFound()), IsEmpty());
}

TEST(VerdictTest, NamesTheCauseTheUnknownOrNothing) {
  EXPECT_THAT(BuildReport(Found(effect::Id::kUnbalance, "z 299.2 mm")).verdict_sentence,
              HasSubstr("unbalance"));
  EXPECT_THAT(BuildReport(NothingFound()).verdict_sentence, Not(HasSubstr("unbalance")));
  DiagnosisResult s = NothingFound();
  s.answer.verdict = Verdict::kUnknown;
  EXPECT_NE(BuildReport(s).verdict_sentence, BuildReport(NothingFound()).verdict_sentence);
}

/// What is left, as multiples of the noise, on data used and on validation data.
DiagnosisResult OnValidation(double fitted, double held, double calibrated) {
  DiagnosisResult s = Found(effect::Id::kEddyCurrent, "all axes");
  s.separate_validation = true;
  s.fitted.extended_over_noise = fitted * fitted;
  s.validation.extended_over_noise = held * held;
  s.validation.calibrated_over_noise = calibrated * calibrated;
  return s;
}

TEST(HoldoutCheck, IsDeniedWhereMuchMoreThanTheNoiseIsLeftOnValidationData) {
  const DiagnosisResult fails = OnValidation(1.0, 77.0, 59.0);
  EXPECT_THAT(BuildReport(fails).verdict_sentence, HasSubstr("does not carry over"));
  EXPECT_THAT(BuildReport(fails).verdict_sentence, HasSubstr("77 times the noise"));
  EXPECT_THAT(BuildReport(fails).verdict_sentence,
              HasSubstr("worse there than without (59 times)"));
  EXPECT_TRUE(BuildReport(fails).needs_experiment);
  const DiagnosisResult holds = OnValidation(1.0, 1.1, 9.0);
  EXPECT_THAT(BuildReport(holds).verdict_sentence, Not(HasSubstr("carry over")));
  EXPECT_FALSE(BuildReport(holds).needs_experiment);
  // What is not understood on the data used either is said by the verdict itself.
  EXPECT_TRUE(PassesValidation(BuildReport(OnValidation(5.0, 6.0, 9.0))));
  EXPECT_THAT(BuildReport(OnValidation(1.0, 20.0, 59.0)).verdict_sentence,
              Not(HasSubstr("worse there")));
}

TEST(HoldoutCheck, AsksForASpeedThatWasNotFitted) {
  DiagnosisResult s = OnValidation(1.0, 77.0, 59.0);
  EXPECT_THAT(BuildReport(s).next_experiment, Not(HasSubstr("run-up")));
  s.fastest_rad_per_s = 100.0;
  s.validation_fastest_rad_per_s = 300.0;
  EXPECT_THAT(BuildReport(s).next_experiment, HasSubstr("run-up"));
}

DiagnosisResult NothingFoundIn(double speed_rad_per_s, bool excited) {
  DiagnosisResult s = NothingFound();
  s.fastest_rad_per_s = speed_rad_per_s;
  s.excited = excited;
  return s;
}

TEST(VerdictTest, OfNothingSaysWhatTheRecordsCannotTell) {
  const DiagnosisResult complete = NothingFoundIn(300.0, true);
  EXPECT_THAT(UnobservableSentence(complete), IsEmpty());
  EXPECT_THAT(UnobservableEffects(complete), IsEmpty());
  EXPECT_FALSE(BuildReport(complete).needs_experiment);
  EXPECT_THAT(BuildReport(complete).verdict_sentence, Not(HasSubstr("as far as these records")));

  const DiagnosisResult standing = NothingFoundIn(0.0, true);
  EXPECT_THAT(BuildReport(standing).verdict_sentence,
              AllOf(HasSubstr("as far as these records"), HasSubstr("does not turn"),
                    HasSubstr("unbalance"), Not(HasSubstr("extra_delay"))));
  EXPECT_THAT(UnobservableEffects(standing), ::testing::Contains(effect::Id::kMisalignment));
  EXPECT_THAT(BuildReport(standing).next_experiment, HasSubstr("spinning"));

  const DiagnosisResult quiet = NothingFoundIn(300.0, false);
  EXPECT_THAT(
      BuildReport(quiet).verdict_sentence,
      AllOf(HasSubstr("no test signal"), HasSubstr("extra_delay"), Not(HasSubstr("unbalance"))));
  EXPECT_TRUE(BuildReport(quiet).needs_experiment);
}

TEST(CalibratedValues, AreTotalsUnderTheKeysOfTheFileWithWhatTheyMovedBy) {
  DiagnosisResult s = NothingFound();
  for (std::size_t t = 0; t < s.terms.size(); ++t) {
    const Term& term = s.terms[t];
    const bool unbalance = term.effect_name() == "unbalance" && term.location.name == "z 299.2 mm";
    if (term.effect_name() == "extra_delay" || unbalance ||
        (term.effect_name() == "modal_frequency" && term.location.name == "mode 1")) {
      s.answer.calibration.push_back({t, 2.0 * term.tolerance, 0.5 * term.tolerance});
    }
  }
  const auto values = CalibratedValues(s);
  ASSERT_EQ(values.size(), 3U);
  for (const CalibratedValue& v : values) {
    EXPECT_TRUE(IsSignificant(v)) << v.effect;
    if (v.effect == "extra_delay") {
      // One period in the file, two tolerances of 0.05 more.
      EXPECT_EQ(v.key, "delay_samples");
      EXPECT_NEAR(v.nominal, 1.0, 1e-12);
      EXPECT_NEAR(v.calibrated, 1.1, 1e-12);
      EXPECT_NEAR(v.deviation, 0.025, 1e-12);
      EXPECT_NEAR(v.tolerance, 0.05, 1e-12);
    } else if (v.effect == "modal_frequency") {
      EXPECT_EQ(v.key, "frequency_hz");
      EXPECT_NEAR(v.calibrated, 1.02 * v.nominal, 1e-9 * v.nominal);
      EXPECT_NEAR(v.tolerance, 0.01 * v.nominal, 1e-9 * v.nominal);
    } else {
      // 18 g mm in the file, at its phase, and two tolerances of 3 g mm in both parts.
      const auto& mass = FlexibleRotor().plant.unbalance.at(1);
      const auto sum = std::polar(1e6 * mass.moment_kg_m, mass.phase_rad) + std::complex(6.0, 6.0);
      EXPECT_EQ(v.key, "moment_g_mm");
      EXPECT_NEAR(v.nominal, 18.0, 1e-9);
      EXPECT_NEAR(v.calibrated, std::abs(sum), 1e-9);
      ASSERT_TRUE(v.phase_rad.has_value());
      EXPECT_NEAR(*v.phase_rad, std::arg(sum), 1e-9);
      EXPECT_NEAR(v.moved, 2.0 * std::sqrt(2.0), 1e-9);
    }
  }
}

TEST(ConfidenceTest, FallsWithARivalAndWithALowScore) {
  DiagnosisResult s = Found(effect::Id::kEddyCurrent, "de_x");
  const double alone = BuildReport(s).confidence;
  EXPECT_GT(alone, 0.99);
  s.answer.candidates.push_back({.effect = effect::Id::kExtraDelay, .place = "all", .score = 19.5});
  EXPECT_LT(BuildReport(s).confidence, 0.7);
  EXPECT_GT(BuildReport(s).confidence, 0.5);  // still the first of two
  s = Found(effect::Id::kEddyCurrent, "de_x");
  s.answer.candidates.front().score = 0.0;
  EXPECT_NEAR(BuildReport(s).confidence, 0.5, 1e-9);
}

TEST(ConfidenceTest, OfNoneIsAgainstAllCandidatesAndOfUnknownZero) {
  DiagnosisResult s = NothingFound();
  EXPECT_EQ(BuildReport(s).confidence, 1.0);
  s.answer.candidates.push_back({.effect = effect::Id::kExtraDelay, .place = "all", .score = 0.0});
  EXPECT_NEAR(BuildReport(s).confidence, 0.5, 1e-12);  // even odds
  s.answer.candidates.front().score = -std::log(3.0);
  EXPECT_NEAR(BuildReport(s).confidence, 0.75, 1e-12);  // three to one
  // Of two effects that explain as much as nothing, each is half as likely as that before.
  s.answer.candidates.front().score = 0.0;
  s.answer.candidates.push_back({.effect = effect::Id::kRotorMass, .place = "rotor", .score = 0.0});
  EXPECT_NEAR(BuildReport(s).confidence, 0.5, 1e-12);
  s.answer.verdict = Verdict::kUnknown;
  s.answer.candidates.front().score = 334.0;
  EXPECT_EQ(BuildReport(s).confidence, 0.0);
}

TEST(VerdictTest, OfACauseSaysItsSizeWithItsIntervalAndWhatItsEvidenceIs) {
  // sqrt(tau) of 2.5e-3, known to 0.25e-3: 1.645 of it to either side, squared
  EXPECT_THAT(BuildReport(Found(effect::Id::kEddyCurrent, "de_x")).verdict_sentence,
              AllOf(HasSubstr("tau_us 6.25 us (4.363 to 8.475, 90 % interval)"),
                    HasSubstr("20 nat, which is odds of 10^8 : 1")));
  EXPECT_THAT(BuildReport(Found(effect::Id::kUnbalance, "z 299.2 mm")).verdict_sentence,
              HasSubstr("moment_g_mm 14.14 g mm"));
}

TEST(VerdictTest, OfACauseThatCalibrationCouldAbsorbSaysWhyItIsNamed) {
  DiagnosisResult s = Found(effect::Id::kEddyCurrent, "de_x");
  s.answer.candidates.front().score = 2.0;
  EXPECT_THAT(BuildReport(s).verdict_sentence,
              AllOf(HasSubstr("further from the rig file than its tolerances allow"),
                    HasSubstr("leaves 2 nat for it"), Not(HasSubstr("odds"))));
}

TEST(VerdictTest, OfNothingSaysWhetherTheFileAsItStandsExplainsTheData) {
  DiagnosisResult s = NothingFound();
  EXPECT_THAT(BuildReport(s).verdict_sentence, HasSubstr("as it stands"));
  EXPECT_THAT(BuildReport(s).verdict_sentence, Not(HasSubstr("does not")));
  for (std::size_t t = 0; t < s.terms.size(); ++t) {
    const Term& term = s.terms[t];
    if (term.effect_name() != "current_gain") continue;
    s.answer.calibration.push_back({t, 1.5 * term.tolerance, 0.1 * term.tolerance});
  }
  s.validation.to_gain = {99.0, 90.0, 110.0};  // squared, less the noise itself
  EXPECT_THAT(BuildReport(s).verdict_sentence,
              AllOf(HasSubstr("4 numbers moved by at most 1.5 tolerances"),
                    HasSubstr("as it stands it does not (10.0 times the noise, rms)")));
}

TEST(PlanTest, IsAScenarioThatTheReaderTakesForEveryCause) {
  const DiagnosisResult nothing = NothingFound();
  for (const Hypothesis& h : MakeHypotheses(*nothing.view, nothing.terms)) {
    const std::string text = PlanScenario(BuildReport(Found(h.effect, h.place)), FlexibleRotor());
    const auto scenario =
        configuration::ParseScenario(text, "diagnosis_next.yaml", nothing.view->numbers);
    ASSERT_GT(scenario.steps.size(), 2U) << effect::At(h.effect).name;
  }
}

TEST(PlanTest, ExcitesEveryAxisAndTurnsTheRotorForCausesOfRotation) {
  const std::string turning =
      PlanScenario(BuildReport(Found(effect::Id::kUnbalance, "z 299.2 mm")), FlexibleRotor());
  for (const char* channel :
       {"channel: de_x", "channel: de_y", "channel: nde_x", "channel: nde_y"}) {
    EXPECT_THAT(turning, HasSubstr(channel));
  }
  EXPECT_THAT(turning, HasSubstr("do: spin"));
  EXPECT_THAT(PlanScenario(BuildReport(Found(effect::Id::kCurrentGain, "de_x")), FlexibleRotor()),
              Not(HasSubstr("do: spin")));
}

TEST(PlanTest, UsesTheFastestClockForWhatDiffersAtHighFrequency) {
  EXPECT_THAT(PlanScenario(BuildReport(Found(effect::Id::kEddyCurrent, "de_x")), FlexibleRotor()),
              HasSubstr("divisor: 1}"));
  EXPECT_THAT(PlanScenario(BuildReport(Found(effect::Id::kCurrentGain, "de_x")), FlexibleRotor()),
              HasSubstr("divisor: 2}"));
}

}  // namespace
}  // namespace levitas::diagnosis
