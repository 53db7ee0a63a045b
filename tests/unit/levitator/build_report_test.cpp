// The report of a levitator names the place of every cause that its diagnosis can find.

#include "diagnosis/levitator/build_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "diagnosis/levitator/causes.hpp"
#include "diagnosis/report/advice.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

std::string NameOf(const diagnosis::Hypothesis& cause) {
  return std::string(effect::At(cause.effect).name);
}

diagnosis::Candidate Refitted(const diagnosis::Hypothesis& cause, double nat) {
  return {cause.effect, cause.place, nat, diagnosis::IndexOf(AllCauses(), cause), true};
}

/// Two seconds of a coil that is modelled exactly, but for the noise of its probe; the causes are
/// said to be `theta`.
diagnosis::DiagnosisReport ReportOf(const Causes& causes, const Theta& theta = Zeros(1)) {
  const configuration::RigFile rig = test::LevitatorFile();
  const NominalRig nominal = NominalOf(rig);
  LevitatorResult result;
  result.found.causes = causes;
  result.found.calibrated.theta = Zeros(1);
  result.found.extended.theta = theta;
  result.found.calibrated.deviation = result.found.extended.deviation = Zeros(1);
  for (const diagnosis::Hypothesis& cause : causes) {
    result.found.in_place.push_back({Refitted(cause, 100.0)});
  }
  const Series series = test::LivelySeries(nominal, Zeros(1), 2000, 4);
  return BuildReport(rig, nominal, {series}, result);
}

TEST(LevitatorReport, SaysThePlaceOfEveryCauseAlsoOfThoseNoRotorHas) {
  for (const diagnosis::Hypothesis& cause : AllCauses()) {
    const diagnosis::DiagnosisReport report = ReportOf({cause});
    ASSERT_EQ(report.causes.size(), 1U);
    EXPECT_EQ(report.causes[0].effect, NameOf(cause));
    EXPECT_EQ(report.place, effect::Name(effect::At(cause.effect).place)) << NameOf(cause);
    EXPECT_NE(report.place, "") << NameOf(cause);
  }
}

TEST(LevitatorReport, SaysWhetherADelayIsLongerThanTheFilesOrShorter) {
  const Causes delay{
      *std::ranges::find(AllCauses(), effect::Id::kExtraDelay, &diagnosis::Hypothesis::effect)};
  Theta theta = Zeros(1);
  theta[kDelay] = 1.5;
  const std::string late = ReportOf(delay, theta).headline;
  EXPECT_NE(late.find("Currents act too late"), std::string::npos) << late;
  EXPECT_NE(late.find("1.5 samples where the file says 0"), std::string::npos) << late;
  theta[kDelay] = -0.5;
  const std::string early = ReportOf(delay, theta).headline;
  EXPECT_NE(early.find("Currents act earlier than the rig file says"), std::string::npos) << early;
}

// The size is said without a sign, since the name says which way.
TEST(LevitatorReport, SaysAPercentageByTheNameOfItsSide) {
  const Causes profile{*std::ranges::find(AllCauses(), effect::Id::kInductanceProfile,
                                          &diagnosis::Hypothesis::effect)};
  Theta theta = Zeros(1);
  for (const auto& [size, name] : {std::pair{0.4, "falls too little"}, {-0.4, "falls too much"}}) {
    theta[kProfile] = size;
    const std::string headline = ReportOf(profile, theta).headline;
    EXPECT_NE(headline.find(name), std::string::npos) << headline;
    EXPECT_NE(headline.find(", 40 % of"), std::string::npos) << headline;
  }
}

TEST(LevitatorReport, SaysEveryCauseInWordsWithWhatToCheck) {
  for (const diagnosis::Hypothesis& cause : AllCauses()) {
    const diagnosis::DiagnosisReport report = ReportOf({cause});
    const effect::Words* words = diagnosis::FindWords(report, NameOf(cause));
    ASSERT_NE(words, nullptr) << NameOf(cause);
    EXPECT_NE(report.headline.find("[" + NameOf(cause) + "]"), std::string::npos);
    EXPECT_NE(report.action.find(words->check), std::string::npos) << report.action;
    EXPECT_FALSE(report.parameters.empty()) << NameOf(cause);
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
  const auto of = [](effect::Id effect) {
    return *std::ranges::find(AllCauses(), effect, &diagnosis::Hypothesis::effect);
  };
  found.causes = {of(effect::Id::kRotorMass)};
  found.in_place = {{Refitted(found.causes.front(), 300.0)}};
  const auto add = [&](effect::Id effect, double behind_nat, bool refitted) {
    found.in_place.front().push_back(Refitted(of(effect), 300.0 - behind_nat));
    found.in_place.front().back().refitted = refitted;
  };
  add(effect::Id::kForceConstant, 2.0, true);
  add(effect::Id::kStaticLoad, 40.0, true);
  add(effect::Id::kSensorGain, 2.0, false);  // from the linearised model alone
  diagnosis::DiagnosisReport report;
  ReportCauses(found, report);
  EXPECT_EQ(report.also_possible, std::vector<std::string>{"force_constant"});
  ASSERT_EQ(report.candidates.size(), 4U);
  EXPECT_EQ(report.candidates[1].reason, "not separable from rotor_mass");
  EXPECT_EQ(report.candidates[2].reason, "explains 2 nat less than rotor_mass in its place");
  EXPECT_EQ(report.candidates[3].reason, "explains 40 nat less than rotor_mass in its place");
}

// Two causes are named. An effect that is not named is compared with one of them alone: the one
// whose gain it comes nearest to when it stands in that cause's place.
TEST(LevitatorReport, TellsOfACandidateInThePlaceOfTheCauseThatItDoesMostFor) {
  Found found;
  const auto of = [](effect::Id effect) {
    return *std::ranges::find(AllCauses(), effect, &diagnosis::Hypothesis::effect);
  };
  found.causes = {of(effect::Id::kExtraDelay), of(effect::Id::kRotorMass)};
  const auto other = [&](double nat) { return Refitted(of(effect::Id::kForceConstant), nat); };
  found.in_place = {{Refitted(found.causes[0], 900.0), other(10.0)},
                    {Refitted(found.causes[1], 300.0), other(299.0)}};
  diagnosis::DiagnosisReport report;
  ReportCauses(found, report);
  EXPECT_TRUE(report.also_possible.empty());
  EXPECT_EQ(report.ties[1].others, std::vector<std::string>{"force_constant"});
  ASSERT_EQ(report.candidates.size(), 3U);
  EXPECT_EQ(report.candidates[2].evidence_nat, 299.0);
  EXPECT_EQ(report.candidates[2].reason, "not separable from rotor_mass");
}

}  // namespace
}  // namespace levitas::levitator
