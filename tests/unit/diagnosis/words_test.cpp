// What a diagnosis says.

#include "diagnosis/words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "config/rig_file.hpp"
#include "diagnosis/plan.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(ParametersTest, OfAHarmonicAreItsAmplitudeAndItsPhase) {
  const auto parameters = Parameters(Found("unbalance", "z 299.2 mm"));
  ASSERT_EQ(parameters.size(), 2U);
  for (const NamedParameter& p : parameters) {
    EXPECT_LT(p.low, p.value);
    EXPECT_GT(p.high, p.value);
    const bool phase = p.unit == "rad";
    EXPECT_NEAR(p.value, phase ? std::atan2(1.0, 1.0) : std::sqrt(2.0) * 10e-6,
                phase ? 1e-9 : 1e-12);
  }
}

TEST(ParametersTest, OfAnEddyCurrentAreItsTimeConstant) {
  const auto parameters = Parameters(Found("eddy_current", "de_x"));
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_EQ(parameters[0].name, "tau_s[de_x]");
  EXPECT_NEAR(parameters[0].value, std::pow(2.5e-3, 2), 1e-15);
  EXPECT_GE(parameters[0].low, 0.0);
}

TEST(ParametersTest, OfAGainAreTheFactorOnTheNominalValue) {
  const auto parameters = Parameters(Found("current_gain", "nde_x"));
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_NEAR(parameters[0].value, 1.075, 1e-12);
}

TEST(PlaceTest, OfEveryEffectIsOneOfTheVocabularys) {
  const SessionAnswer s = NothingFound();
  for (const Term& term : s.terms) {
    if (term.effect.empty()) continue;
    EXPECT_THAT(
        PlaceOfEffect(term.effect),
        ::testing::AnyOf("timing", "amplifier", "magnet", "sensor", "rotor", "support", "external"))
        << term.effect;
  }
  EXPECT_EQ(PlaceOf(Found("axis_rotation", "sensor de")), "sensor");
  EXPECT_EQ(PlaceOf(Found("axis_rotation", "magnet de")), "magnet");
  EXPECT_EQ(PlaceOf(NothingFound()), "");
}

TEST(PlaceTest, OfAnUnknownIsThatOfWhatItFollows) {
  SessionAnswer s = NothingFound();
  s.answer.verdict = Verdict::kUnknown;
  s.answer.remainder.coherent_with = "current";
  EXPECT_EQ(PlaceOf(s), "magnet");
  s.answer.remainder.coherent_with = "rotation";
  EXPECT_EQ(PlaceOf(s), "rotor");
  s.answer.remainder.coherent_with = "nothing";
  EXPECT_EQ(PlaceOf(s), "external");
}

TEST(ChannelsTest, AreThoseOfTheCause) {
  EXPECT_THAT(Channels(Found("current_gain", "nde_x")), ElementsAre("nde_x"));
  EXPECT_THAT(Channels(Found("current_gain", "de")), ElementsAre("de_x", "de_y"));
  EXPECT_THAT(Channels(Found("sensor_runout", "order 2, de_y")), ElementsAre("de_y"));
  EXPECT_EQ(Channels(Found("unbalance", "z 299.2 mm")).size(), 4U);
  EXPECT_THAT(Channels(NothingFound()), IsEmpty());
}

TEST(VerdictTest, NamesTheCauseTheUnknownOrNothing) {
  EXPECT_THAT(VerdictSentence(Found("unbalance", "z 299.2 mm")), HasSubstr("unbalance"));
  EXPECT_THAT(VerdictSentence(NothingFound()), Not(HasSubstr("unbalance")));
  SessionAnswer s = NothingFound();
  s.answer.verdict = Verdict::kUnknown;
  EXPECT_NE(VerdictSentence(s), VerdictSentence(NothingFound()));
}

TEST(ConfidenceTest, FallsWithARivalAndWithALowScore) {
  SessionAnswer s = Found("eddy_current", "de_x");
  const double alone = Confidence(s);
  EXPECT_GT(alone, 0.99);
  s.answer.candidates.push_back({.effect = "extra_delay", .place = "all", .score = 19.5});
  EXPECT_LT(Confidence(s), 0.7);
  EXPECT_GT(Confidence(s), 0.5);  // still the first of two
  s = Found("eddy_current", "de_x");
  s.answer.candidates.front().score = 0.0;
  EXPECT_NEAR(Confidence(s), 0.5, 1e-9);
}

TEST(PlanTest, IsAScenarioThatTheReaderTakesForEveryCause) {
  const SessionAnswer nothing = NothingFound();
  for (const Hypothesis& h : MakeHypotheses(*nothing.view, nothing.terms)) {
    const std::string text = PlanScenario(Found(h.effect, h.place));
    const auto scenario = config::ParseScenario(text, "diagnosis_next.yaml", nothing.view->numbers);
    ASSERT_GT(scenario.steps.size(), 2U) << h.effect;
  }
}

TEST(PlanTest, ExcitesEveryAxisAndTurnsTheRotorForCausesOfRotation) {
  const std::string turning = PlanScenario(Found("unbalance", "z 299.2 mm"));
  for (const char* channel :
       {"channel: de_x", "channel: de_y", "channel: nde_x", "channel: nde_y"}) {
    EXPECT_THAT(turning, HasSubstr(channel));
  }
  EXPECT_THAT(turning, HasSubstr("do: spin"));
  EXPECT_THAT(PlanScenario(Found("current_gain", "de_x")), Not(HasSubstr("do: spin")));
}

TEST(PlanTest, UsesTheFastestClockForWhatDiffersAtHighFrequency) {
  EXPECT_THAT(PlanScenario(Found("eddy_current", "de_x")), HasSubstr("divisor: 1}"));
  EXPECT_THAT(PlanScenario(Found("current_gain", "de_x")), HasSubstr("divisor: 2}"));
}

}  // namespace
}  // namespace levitas::diagnosis
