// Every cause that can be named has a parameter, and changes the rig file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/reading_noise.hpp"
#include "configuration/rig_file.hpp"
#include "diagnosis/report/build_report.hpp"
#include "diagnosis/report/calibrated_rig.hpp"
#include "diagnosis/report/event_values.hpp"
#include "diagnosis/report/extended_rig.hpp"
#include "diagnosis/report/named_values.hpp"
#include "diagnosis/report/report_text.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string Rig(const std::string& text) {
  return configuration::WriteRig(configuration::ParseRig(text, "extended_rig.yaml"));
}

/// An event as FindEvents names it, without a term.
DiagnosisResult Event(effect::Id effect, const char* place) {
  DiagnosisResult s = NothingFound();
  s.answer.verdict = Verdict::kEffect;
  Hypothesis cause;
  cause.effect = effect;
  cause.place = place;
  s.answer.causes = {cause};
  s.answer.candidates.push_back({.effect = effect, .place = place, .score = 90.0});
  return s;
}

TEST(NamedCause, HasAParameterAndChangesTheRigFileInBothDirections) {
  const std::string nominal = configuration::WriteRig(FlexibleRotor());
  const DiagnosisResult nothing = NothingFound();
  std::set<effect::Id> first;
  for (const Hypothesis& h : MakeHypotheses(*nothing.view, nothing.terms)) {
    for (const double share : {0.5, -0.5}) {
      const bool positive = std::any_of(h.terms.begin(), h.terms.end(),
                                        [&](std::size_t t) { return nothing.terms[t].positive; });
      if (share < 0.0 && (positive || !first.insert(h.effect).second)) continue;
      const DiagnosisResult found = Found(h.effect, h.place, share);
      EXPECT_FALSE(Parameters(found).empty())
          << effect::At(h.effect).name << " at " << h.place << share;
      EXPECT_NE(Rig(ExtendedRig(found, FlexibleRotor())), nominal)
          << effect::At(h.effect).name << " at " << h.place << share;
    }
  }
}

TEST(NamedCause, ADelayShorterThanTheFilesIsAValueOfTheFilesOwnKey) {
  // Half of the prior deviation of half a sample less than the file's one.
  const DiagnosisResult found = Found(effect::Id::kExtraDelay, "all axes", -0.5);
  const auto parameters = Parameters(found);
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_EQ(parameters[0].key, "delay_samples");
  EXPECT_EQ(parameters[0].unit, "samples");
  EXPECT_NEAR(parameters[0].value, 0.75, 1e-9);
  // A deviation of 0.05 x 0.5 samples, 1.645 of it to either side.
  EXPECT_NEAR(parameters[0].low, 0.75 - 1.645 * 0.025, 1e-3);
  EXPECT_NEAR(parameters[0].high, 0.75 + 1.645 * 0.025, 1e-3);
  EXPECT_THAT(TotalSentences(parameters),
              ElementsAre("the delay is 0.75 samples, the rig file says 1"));
  for (const std::string& text :
       {ExtendedRig(found, FlexibleRotor()), CalibratedRig(found, FlexibleRotor())}) {
    const configuration::RigFile rig = configuration::ParseRig(text, "rig.yaml");
    EXPECT_NEAR(rig.plant.delay_samples, 0.75, 1e-6);
    EXPECT_TRUE(rig.plant.effects.empty());
  }
  EXPECT_THAT(BuildReport(found).headline,
              HasSubstr("Currents act earlier than the rig file says, 0.75 samples where the file "
                        "says 1 [extra_delay]"));
}

TEST(NamedCause, OfLostFramesIsHowOftenTheyAreLostAndHowManyInARow) {
  DiagnosisResult s = Event(effect::Id::kDroppedSamples, "300 frames");
  s.lost_frames = {.sent = 100200, .lost = 300, .bursts = 100};
  const auto parameters = Parameters(s);
  ASSERT_EQ(parameters.size(), 2U);
  EXPECT_EQ(parameters[0].key, "probability");
  EXPECT_NEAR(parameters[0].value, 1e-3, 1e-9);  // 100 of the 100 000 that began none
  EXPECT_NEAR(parameters[0].high, 1e-3 * (1.0 + 1.645 / 10.0), 1e-6);
  EXPECT_EQ(parameters[1].value, 3.0);
  const configuration::RigFile rig =
      configuration::ParseRig(ExtendedRig(s, FlexibleRotor()), "rig.yaml");
  ASSERT_EQ(rig.plant.effects.size(), 1U);
  EXPECT_NEAR(rig.plant.effects[0].values[0], 1e-3, 1e-9);
  EXPECT_EQ(rig.plant.effects[0].values[1], 3.0);
}

TEST(NamedCause, OfNoiseIsItsLevelWithoutTheConvertersSteps) {
  DiagnosisResult s = Event(effect::Id::kSensorNoise, "de_y, nde_y");
  const auto& sensor = s.view->bearing(1).sensor;
  // Twice the noise of the file, and the same steps.
  const double steps =
      std::pow(analysis::ReadingNoise(sensor), 2) - std::pow(sensor.noise_rms_m, 2);
  for (auto& channel : s.answer.residual.channels) {
    channel.noise_rms_m = std::sqrt(std::pow(2.0 * sensor.noise_rms_m, 2) + steps);
  }
  const auto parameters = Parameters(s);
  ASSERT_EQ(parameters.size(), 2U);
  EXPECT_EQ(parameters[0].name, "rms_um[de_y]");
  EXPECT_EQ(parameters[1].name, "rms_um[nde_y]");
  EXPECT_NEAR(parameters[0].value, 2e6 * sensor.noise_rms_m, 1e-6);
  EXPECT_THAT(BracketText(parameters[0]), testing::IsEmpty()) << "how well is not known";
  const configuration::RigFile rig =
      configuration::ParseRig(ExtendedRig(s, FlexibleRotor()), "rig.yaml");
  ASSERT_EQ(rig.plant.effects.size(), 2U);
  EXPECT_NEAR(rig.plant.effects[0].values[0], 2.0 * sensor.noise_rms_m, 1e-11);
  // A file that says so itself is not told twice.
  configuration::RigFile told = FlexibleRotor();
  told.plant.effects = EventEntries(s);
  const configuration::RigFile again = configuration::ParseRig(ExtendedRig(s, told), "rig.yaml");
  EXPECT_EQ(again.plant.effects.size(), 2U);
}

TEST(NamedCause, SaysOfABracketWhatItIs) {
  EXPECT_THAT(BuildReport(Found(effect::Id::kEddyCurrent, "de_x")).verdict_sentence,
              HasSubstr("(4.363 to 8.475, 90 % interval)"));
  const std::string slew =
      BuildReport(Found(effect::Id::kAmplifierSlew, "1500 A/s")).verdict_sentence;
  EXPECT_THAT(slew, HasSubstr("neighbouring forms)"));
  EXPECT_THAT(slew, testing::Not(HasSubstr("90 %")));
}

}  // namespace
}  // namespace levitas::diagnosis
