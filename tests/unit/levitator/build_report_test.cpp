// The report of a levitator names the place of every cause that its diagnosis can find.

#include "diagnosis/levitator/build_report.hpp"

#include <gtest/gtest.h>

#include "diagnosis/levitator/causes.hpp"
#include "diagnosis/report/advice.hpp"
#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

/// Two seconds of a coil that is modelled exactly, but for the noise of its probe.
diagnosis::DiagnosisReport ReportOf(const CauseSet& causes) {
  const configuration::RigFile rig = test::LevitatorFile();
  const NominalRig nominal = NominalOf(rig);
  LevitatorResult result;
  result.found.causes = causes;
  result.found.calibrated.theta = result.found.extended.theta = Zeros(1);
  result.found.calibrated.deviation = result.found.extended.deviation = Zeros(1);
  for (const std::size_t c : causes) {
    result.found.scores.push_back({.cause = c, .nat = 100.0, .named = true, .refitted = true});
  }
  const Series series = test::LivelySeries(nominal, Zeros(1), 2000, 4);
  return BuildReport(rig, nominal, {series}, result);
}

TEST(LevitatorReport, SaysThePlaceOfEveryCauseAlsoOfThoseNoRotorHas) {
  for (std::size_t c = 0; c < Causes().size(); ++c) {
    const diagnosis::DiagnosisReport report = ReportOf({c});
    ASSERT_EQ(report.causes.size(), 1U);
    EXPECT_EQ(report.causes[0].effect, Causes()[c].effect);
    EXPECT_EQ(report.place, Table()[Causes()[c].moves.front()].place) << Causes()[c].effect;
    EXPECT_NE(report.place, "") << Causes()[c].effect;
  }
}

TEST(LevitatorReport, SaysEveryCauseInWordsWithWhatToCheck) {
  for (std::size_t c = 0; c < Causes().size(); ++c) {
    const diagnosis::DiagnosisReport report = ReportOf({c});
    const effect::Words* words = diagnosis::FindWords(report, Causes()[c].effect);
    ASSERT_NE(words, nullptr) << Causes()[c].effect;
    EXPECT_NE(report.headline.find("[" + Causes()[c].effect + "]"), std::string::npos);
    EXPECT_NE(report.action.find(words->check), std::string::npos) << report.action;
    EXPECT_FALSE(report.parameters.empty()) << Causes()[c].effect;
  }
}

TEST(LevitatorReport, OfAHealthyRigHasNoCauseNoPlaceAndNothingToRecord) {
  const diagnosis::DiagnosisReport report = ReportOf({});
  EXPECT_EQ(report.verdict, diagnosis::Verdict::kNone);
  EXPECT_EQ(report.place, "");
  EXPECT_TRUE(report.channels.empty());
  EXPECT_FALSE(report.needs_experiment);
  EXPECT_EQ(report.spectra.channel, "ball_x");
}

TEST(LevitatorReport, TiesACandidateThatExplainsNearlyAsMuchInACausesPlace) {
  Found found;
  const auto index = [](const std::string& effect) {
    for (std::size_t c = 0; c < Causes().size(); ++c) {
      if (Causes()[c].effect == effect) return c;
    }
    return Causes().size();
  };
  const std::size_t named = index("rotor_mass");
  found.causes = {named};
  found.scores = {{.cause = named, .nat = 300.0, .named = true, .refitted = true}};
  const auto add = [&](const char* effect, double behind_nat, bool refitted) {
    found.scores.push_back({.cause = index(effect),
                            .nat = 300.0 - behind_nat,
                            .behind_nat = behind_nat,
                            .refitted = refitted,
                            .instead_of = named});
  };
  add("current_gain", 2.0, true);
  add("static_load", 40.0, true);
  add("sensor_gain", 2.0, false);  // from the linearised model alone
  diagnosis::DiagnosisReport report;
  AddCauses(found, report);
  EXPECT_EQ(report.also_possible, std::vector<std::string>{"current_gain"});
  ASSERT_EQ(report.candidates.size(), 4U);
  EXPECT_EQ(report.candidates[1].reason, "not separable from rotor_mass");
  EXPECT_EQ(report.candidates[2].reason, "explains 40 nat less than rotor_mass in its place");
}

}  // namespace
}  // namespace levitas::levitator
