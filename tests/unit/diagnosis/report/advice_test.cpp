// The answer for who acts on it: no sentence contradicts the numbers beside it.

#include "diagnosis/report/advice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/report/build_report.hpp"
#include "diagnosis/report/report_text.hpp"
#include "diagnosis/report/severity.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// No cause; a candidate of so many nats, and 33 that explain nothing.
DiagnosisResult WithCandidate(double nat, bool refitted) {
  DiagnosisResult s = NothingFound();
  s.answer.candidates.push_back(
      {.effect = effect::Id::kRotorMass, .place = "rotor", .score = nat, .refitted = refitted});
  for (int i = 0; i < 33; ++i) {
    s.answer.candidates.push_back(
        {.effect = effect::Id::kEddyCurrent, .place = "de_x", .score = -10.0});
  }
  return s;
}

/// No cause; the current gain of nde_x so many deviations from the file, and tolerances.
DiagnosisResult WithGainOff(double deviations, double tolerances) {
  DiagnosisResult s = NothingFound();
  for (std::size_t t = 0; t < s.terms.size(); ++t) {
    const Term& term = s.terms[t];
    if (term.effect_name() != "current_gain" || term.location.name != "nde_x") continue;
    const double off = -tolerances * term.tolerance;
    s.answer.calibration.push_back({t, off, std::abs(off) / deviations});
  }
  return s;
}

std::string RubPlace() {
  const DiagnosisResult nothing = NothingFound();
  for (const Hypothesis& h : MakeHypotheses(*nothing.view, nothing.terms)) {
    if (h.effect == effect::Id::kTouchdownRub) return h.place;
  }
  return {};
}

TEST(Headline, OfEveryCauseIsInWordsWithItsIdInBrackets) {
  const DiagnosisResult nothing = NothingFound();
  for (const Hypothesis& h : MakeHypotheses(*nothing.view, nothing.terms)) {
    const DiagnosisReport report = BuildReport(Found(h.effect, h.place));
    const std::string id(effect::At(h.effect).name);
    const std::string words(FindWords(report, id)->name);
    const std::string opposite(FindWords(report, id)->opposite);
    EXPECT_TRUE(report.headline.starts_with(words) ||
                (!opposite.empty() && report.headline.starts_with(opposite)))
        << report.headline;
    EXPECT_THAT(report.headline, HasSubstr("[" + id + "]"));
    EXPECT_THAT(report.headline, Not(HasSubstr("nat")));
    EXPECT_THAT(report.headline, Not(HasSubstr("  "))) << h.place;
    EXPECT_THAT(report.action, Not(IsEmpty()));
    EXPECT_THAT(report.severity_sentence, Not(IsEmpty()));
  }
}

TEST(Headline, SaysPlaceAndSizeOnce) {
  const DiagnosisReport weak = BuildReport(Found(effect::Id::kCurrentGain, "nde_x", -0.5));
  // half of a prior deviation of 0.15
  EXPECT_THAT(weak.headline,
              StartsWith("Bearing pulls too weakly for its current at nde_x, by 7.5 % "
                         "[current_gain]: nearly certain"));
  EXPECT_THAT(BuildReport(Found(effect::Id::kCurrentGain, "nde_x")).headline,
              StartsWith("Bearing pulls too strongly"));
  EXPECT_THAT(BuildReport(Found(effect::Id::kUnbalance, "z 299.2 mm")).headline,
              StartsWith("Unbalance near z = 299 mm, 14.1 g mm [unbalance]"));
  EXPECT_THAT(BuildReport(Found(effect::Id::kModalFrequency, "mode 1")).headline,
              StartsWith("A bending mode lies elsewhere (bending mode 1), "));
}

TEST(Headline, NamesOfEveryAxisByItselfThoseOfWhichItIsTrue) {
  DiagnosisResult s = Found(effect::Id::kCurrentGain, "every axis by itself");
  ASSERT_EQ(s.answer.parameters.size(), 4U);
  const auto say = [&s](const std::vector<double>& gains) {
    for (std::size_t i = 0; i < gains.size(); ++i) {
      s.answer.parameters[i].value = gains[i];
      s.answer.extended.theta[s.answer.parameters[i].term] = gains[i];
    }
    return BuildReport(s).headline;
  };
  EXPECT_THAT(say({0.1, 0.06, -0.14, 0.03}),
              HasSubstr("too weakly for its current at nde_x, by 14 %"));
  EXPECT_THAT(say({-0.1, 0.01, -0.14, 0.0}), HasSubstr("at de_x, nde_x, by up to 14 %"));
  EXPECT_THAT(say({-0.1, -0.1, -0.14, -0.12}), HasSubstr("on all axes, by up to 14 %"));
}

TEST(Odds, ArePowersOfTen) {
  EXPECT_EQ(OddsText(4974.0), "10^2160 : 1");  // 4974 / ln 10 = 2160.2
  EXPECT_EQ(OddsText(14.0), "10^6 : 1");       // 1 202 604
  EXPECT_EQ(OddsText(5.0), "10^2 : 1");        // 148
  EXPECT_EQ(OddsText(std::log(4.0)), "4 : 1");
  EXPECT_THAT(BuildReport(Found(effect::Id::kEddyCurrent, "de_x")).headline,
              HasSubstr("odds 10^8 : 1"));
}

TEST(Action, StopsTheMachineForACrackAndNotForALateCurrent) {
  DiagnosisResult found = NothingFound();
  for (const Hypothesis& h : MakeHypotheses(*found.view, found.terms)) {
    if (h.effect == effect::Id::kBreathingCrack) found = Found(h.effect, h.place);
  }
  const DiagnosisReport crack = BuildReport(found);
  ASSERT_FALSE(crack.causes.empty());
  EXPECT_EQ(crack.severity, Severity::kSevere);
  EXPECT_THAT(crack.action, StartsWith("Stop the machine."));
  EXPECT_THAT(crack.headline, HasSubstr("% of the diameter deep"));
  EXPECT_EQ(crack.marks.size(), 1U);
  found.answer.verdict = Verdict::kSuspected;
  found.answer.doubt = Doubt::kWeakEvidence;
  found.answer.probability = 0.7;
  EXPECT_THAT(BuildReport(found).action, StartsWith("Run no further than you must"));
  EXPECT_THAT(BuildReport(found).headline, StartsWith("Suspected, 70 %: Crack in the shaft"));
  EXPECT_THAT(BuildReport(Found(effect::Id::kExtraDelay, "all axes")).action,
              HasSubstr("may run on"));
}

// A ring at either bearing is a cause each, of one line.
TEST(Headline, SaysAnEffectAtTwoPlacesOnce) {
  DiagnosisReport report = BuildReport(Found(effect::Id::kTouchdownRub, RubPlace()));
  const DiagnosisReport one = report;
  report.causes.push_back(report.causes.front());
  Advise(report);
  EXPECT_EQ(report.headline, one.headline);
  EXPECT_EQ(report.action, one.action);
  EXPECT_EQ(report.severity_sentence, one.severity_sentence);
}

TEST(Headline, DoesNotSuspectWhatForetellsTheRecordsWorseThanTheRigFile) {
  DiagnosisReport report = BuildReport(Found(effect::Id::kExtraDelay, "all axes"));
  report.verdict = Verdict::kSuspected;
  report.confidence = 0.9999;
  report.validation.nominal_percent = 60.5;
  report.validation.extended_percent = 59.9;
  Advise(report);
  EXPECT_THAT(report.headline, StartsWith("Suspected, over 99.9 %"));
  report.validation.extended_percent = 51.1;
  Advise(report);
  EXPECT_THAT(report.headline, StartsWith("Something is wrong (over 99.9 %), and what is not"));
  EXPECT_THAT(report.headline, HasSubstr("51.1 against 60.5 %"));
  EXPECT_THAT(report.action, StartsWith("Change nothing yet"));
}

TEST(Action, ChangesNothingOnTheMachineWhileTheInputIsDoubted) {
  DiagnosisReport report = BuildReport(Found(effect::Id::kTouchdownRub, RubPlace()));
  report.input_warning = "units are wrong";
  CompleteReport(report);
  EXPECT_THAT(report.action, StartsWith("First check units"));
  EXPECT_THAT(report.headline, StartsWith("Doubtful, check the inputs first."));
  EXPECT_FALSE(AllInOrder(report));
}

TEST(Coherence, NothingFoundIsSaidWithItsConfidenceOnlyWhereItIsLikely) {
  const DiagnosisReport sure = BuildReport(WithCandidate(1.0, true));
  EXPECT_FALSE(sure.undecided);
  // 34 effects, one of them e times as likely as nothing is: 34/(34 + e)
  EXPECT_NEAR(sure.confidence, 34.0 / (34.0 + std::exp(1.0)), 1e-3);
  EXPECT_THAT(sure.headline, StartsWith("No fault found (confidence 93 %)"));
  EXPECT_TRUE(AllInOrder(sure));
  EXPECT_EQ(sure.next_experiment, kNoneNeeded);

  const DiagnosisReport unsure = BuildReport(WithCandidate(11.4, false));
  EXPECT_TRUE(unsure.undecided);
  EXPECT_THAT(unsure.headline, StartsWith("Undecided"));
  EXPECT_THAT(unsure.headline, HasSubstr("[rotor_mass]"));
  EXPECT_THAT(unsure.headline, HasSubstr("confidence under 0.1 %"));
  EXPECT_THAT(unsure.verdict_sentence, Not(HasSubstr("No fault found")));
  EXPECT_NE(unsure.next_experiment, kNoneNeeded);
  EXPECT_FALSE(AllInOrder(unsure));
}

TEST(Coherence, EveryDecisiveCandidateThatIsNotNamedSaysWhy) {
  for (const bool refitted : {false, true}) {
    for (const Verdict verdict : {Verdict::kNone, Verdict::kUnknown}) {
      DiagnosisResult s = WithCandidate(11.4, refitted);
      s.answer.verdict = verdict;
      const std::string reason = BuildReport(s).candidates.front().reason;
      EXPECT_THAT(reason, Not(HasSubstr("than the cause"))) << "there is none";
      EXPECT_THAT(reason,
                  HasSubstr(refitted ? (verdict == Verdict::kNone ? "not confirmed" : "residual")
                                     : "linearised"));
    }
  }
  DiagnosisResult named = Found(effect::Id::kEddyCurrent, "de_x");
  named.answer.candidates.insert(
      named.answer.candidates.begin(),
      {.effect = effect::Id::kRotorMass, .place = "rotor", .score = 31.0, .refitted = true});
  EXPECT_THAT(BuildReport(named).candidates.front().reason, Not(HasSubstr("less than")))
      << "it explains more";
  EXPECT_LT(BuildReport(named).confidence, 0.01) << "of the cause, not of the leader";
}

TEST(Coherence, ANumberThatIsMeasurablyOffIsSaidAndLeadsToHealthyRecords) {
  const DiagnosisReport off = BuildReport(WithGainOff(15.0, 2.2));
  EXPECT_EQ(off.verdict, Verdict::kNone);
  EXPECT_THAT(off.headline, HasSubstr("one number of the rig file is measurably off"));
  EXPECT_THAT(off.headline, HasSubstr("15 standard deviations, 2.2 tolerances"));
  EXPECT_THAT(off.healthy_proposal, HasSubstr("--healthy"));
  EXPECT_THAT(off.next_experiment, HasSubstr("--healthy"));
  EXPECT_FALSE(AllInOrder(off));
  const DiagnosisReport scatter = BuildReport(WithGainOff(4.9, 2.2));
  EXPECT_THAT(scatter.healthy_proposal, IsEmpty());
  EXPECT_TRUE(AllInOrder(scatter));
}

TEST(Coherence, NothingIsInOrderBesideACause) {
  EXPECT_FALSE(AllInOrder(BuildReport(Found(effect::Id::kCurrentGain, "nde_x"))));
  EXPECT_TRUE(AllInOrder(BuildReport(NothingFound())));
}

TEST(Severity, OfAGainIsTheMarginThatItUses) {
  const ReportScale none;
  const auto of = [&](double ratio) {
    return JudgeSize(effect::Yardstick::kLoopGain, ratio, none).severity;
  };
  EXPECT_EQ(of(0.95), Severity::kSlight);
  EXPECT_EQ(of(0.85), Severity::kMarked);  // below sqrt(3/4) = 0.866
  EXPECT_EQ(of(0.74), Severity::kSevere);
  EXPECT_EQ(of(1.2), Severity::kSlight);  // below sqrt(3/2) = 1.225
  EXPECT_EQ(of(1.51), Severity::kSevere);
}

TEST(Severity, OfADeflectionIsItsZone) {
  const ReportScale scale{.clearance_m = 200e-6};
  const auto of = [&](double size_m) {
    return JudgeSize(effect::Yardstick::kClearance, size_m, scale).severity;
  };
  EXPECT_EQ(of(59e-6), Severity::kSlight);
  EXPECT_EQ(of(-61e-6), Severity::kMarked);
  EXPECT_EQ(of(101e-6), Severity::kSevere);
  EXPECT_EQ(JudgeSize(effect::Yardstick::kClearance, 1.0, {}).severity, Severity::kNotSaid);
}

TEST(Severity, OfAnUnbalanceIsItsGrade) {
  // 10 kg at 100 rad/s: 0.25e-3 kg m is 2.5 mm/s
  const ReportScale scale{.rotor_mass_kg = 10.0, .rated_speed_rad_per_s = 100.0};
  const auto of = [&](double moment_kg_m) {
    return JudgeSize(effect::Yardstick::kBalance, moment_kg_m, scale).severity;
  };
  EXPECT_EQ(of(0.24e-3), Severity::kSlight);
  EXPECT_EQ(of(0.26e-3), Severity::kMarked);
  EXPECT_EQ(of(0.64e-3), Severity::kSevere);
}

}  // namespace
}  // namespace levitas::diagnosis
