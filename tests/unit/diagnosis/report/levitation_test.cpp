#include "diagnosis/report/levitation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "common/rotational_speed.hpp"
#include "diagnosis/report/build_report.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kDoesNot = "DOES NOT LEVITATE";

/// The shipped law, of a record that turned with up to 300 rad/s.
KnownLaws ShippedLaw() {
  const std::string path = configuration::FindConfig("flexible_rotor", "controllers");
  LawOfRecords of{.name = "shipped",
                  .law = configuration::LoadController(path, FlexibleRotor().numbers).law,
                  .records = {"run.csv"}};
  of.Add(300.0);
  of.Add(100.0);
  return {{of}, {}};
}

/// All negative stiffnesses of the magnets calibrated to (1 + `more`) times those of the file.
DiagnosisReport CalibratedStiffness(double more, const KnownLaws& laws) {
  DiagnosisResult s = NothingFound();
  for (std::size_t t = 0; t < s.terms.size(); ++t) {
    if (s.terms[t].effect_name() != "displacement_stiffness") continue;
    s.answer.calibrated.theta[t] = s.answer.extended.theta[t] = more;
    s.answer.calibration.push_back({t, more, 0.01});
  }
  s.known_laws = laws;
  return BuildReport(s, FlexibleRotor());
}

/// The comment that a rig file begins with, its lines joined.
std::string HeadOf(const std::string& text) {
  std::istringstream lines(text);
  std::string head;
  for (std::string line; std::getline(lines, line) && line.starts_with('#');) {
    head += line.substr(1);
  }
  return head;
}

TEST(LevitationPair, ACalibratedRigThatLevitatesIsWrittenWithoutAWord) {
  const DiagnosisReport report = CalibratedStiffness(0.03, ShippedLaw());
  EXPECT_THAT(report.levitation.sentences, IsEmpty());
  ASSERT_EQ(report.levitation.by_law.size(), 1U);
  EXPECT_EQ(report.levitation.by_law[0].calibrated_rig.levitates, true);
  EXPECT_EQ(report.levitation.by_law[0].extended_rig.levitates, true);
  EXPECT_THAT(report.calibrated_rig, Not(HasSubstr("LEVITATE")));
}

TEST(LevitationPair, ACalibratedRigThatDoesNotSaysSoAtItsHead) {
  const DiagnosisReport report = CalibratedStiffness(4.0, ShippedLaw());
  ASSERT_EQ(report.levitation.by_law.size(), 1U);
  EXPECT_EQ(report.levitation.by_law[0].calibrated_rig.levitates, false);
  // Nothing is a cause: the extended rig is the file, which levitates.
  EXPECT_EQ(report.levitation.by_law[0].extended_rig.levitates, true);
  EXPECT_EQ(report.levitation.by_law[0].rig_file.levitates, true);
  ASSERT_THAT(report.levitation.sentences,
              ElementsAre(AllOf(StartsWith("calibrated_rig.yaml"), HasSubstr(kDoesNot),
                                HasSubstr("shipped"), HasSubstr("955 to 2865 rpm"),
                                HasSubstr("rig file as given does levitate"))));
  EXPECT_THAT(HeadOf(report.calibrated_rig), HasSubstr(kDoesNot));
  EXPECT_THAT(report.extended_rig, Not(HasSubstr(kDoesNot)));
  // The comment leaves the file a rig file.
  EXPECT_FALSE(
      configuration::ParseRig(report.calibrated_rig, "calibrated_rig.yaml").plant.effects.empty());
}

TEST(LevitationPair, ACauseThatTakesTheLevitationAwayIsSaidOfBothFiles) {
  const auto with_cause = [](double share) {
    DiagnosisResult s = Found(effect::Id::kDisplacementStiffness, "all axes", share);
    s.known_laws = ShippedLaw();
    return BuildReport(s, FlexibleRotor()).levitation;
  };
  EXPECT_THAT(with_cause(0.1).sentences, IsEmpty());
  EXPECT_EQ(with_cause(20.0).sentences.size(), 2U);
}

TEST(LevitationTest, OfALawThatHoldsNoRigSaysThatTheFileDoesNotLevitateEither) {
  KnownLaws laws = ShippedLaw();
  for (law::AxisLawConfig& axis : laws.laws[0].law.axes) axis.kp_a_per_m = 1.0;
  const DiagnosisReport report = CalibratedStiffness(0.0, laws);
  EXPECT_THAT(report.levitation.sentences, ::testing::SizeIs(2));
  EXPECT_THAT(report.levitation.sentences.front(), HasSubstr("Nor does the rig file as given"));
}

TEST(LevitationTest, SaysInOneClauseThatNoLawIsKnown) {
  const DiagnosisReport report = CalibratedStiffness(4.0, {{}, {"standing.csv", "runup.csv"}});
  ASSERT_THAT(report.levitation.sentences,
              ElementsAre(AllOf(HasSubstr("was not judged"), HasSubstr("the law of the records"))));
  EXPECT_THAT(report.levitation.by_law, IsEmpty());
  EXPECT_THAT(HeadOf(report.calibrated_rig), HasSubstr("not judged"));
  EXPECT_THAT(HeadOf(report.extended_rig), HasSubstr("not judged"));
}

TEST(LevitationTest, NamesTheRecordsWithoutALawWhereOthersHaveOne) {
  KnownLaws some = ShippedLaw();
  some.without = {"/of/somebody/standing.csv", "runup.csv"};
  const DiagnosisReport report = CalibratedStiffness(0.0, some);
  EXPECT_THAT(report.levitation.sentences,
              ElementsAre(HasSubstr("the law of standing.csv, runup.csv was not judged")));
  EXPECT_EQ(report.levitation.by_law[0].calibrated_rig.levitates, true);
}

TEST(LevitationTest, OfALawForAnotherRigSaysWhyItWasNotJudged) {
  KnownLaws laws = ShippedLaw();
  laws.laws[0].law.axes.pop_back();
  const DiagnosisReport report = CalibratedStiffness(0.0, laws);
  EXPECT_THAT(report.levitation.sentences, ::testing::Each(HasSubstr("3 axes")));
  EXPECT_THAT(report.levitation.sentences, ::testing::SizeIs(2));
}

TEST(LevitationTest, FindsASpeedBetweenTheEndsAtWhichTheLawLetsGo) {
  KnownLaws laws = ShippedLaw();
  law::LawConfig& law = laws.laws[0].law;
  law.schedule = {{200.0, law.axes, {}}, {400.0, law.axes, {}}};
  laws.laws[0].Add(0.0);
  laws.laws[0].Add(400.0);
  EXPECT_THAT(CalibratedStiffness(0.0, laws).levitation.sentences, IsEmpty());
  for (law::AxisLawConfig& axis : law.schedule[0].axes) axis.kp_a_per_m *= 0.1;
  const ReportLevitations found = CalibratedStiffness(0.0, laws).levitation;
  ASSERT_EQ(found.by_law.size(), 1U);
  EXPECT_EQ(found.by_law[0].calibrated_rig.levitates, false);
  EXPECT_NEAR(found.by_law[0].calibrated_rig.rpm, RadPerSToRpm(200.0), 1.0);
}

}  // namespace
}  // namespace levitas::diagnosis
