// What counts as a right, a partly right and a wrong answer of the diagnosis.

#include "benchmark/accuracy/scores.hpp"

#include <gtest/gtest.h>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::accuracy {
namespace {

TrialScore Hidden(std::vector<effect::Id> truth, std::vector<effect::Id> named,
                  std::vector<effect::Id> ties = {}) {
  TrialScore o;
  o.truth = std::move(truth);
  o.verdict = named.empty() ? "none" : "effect";
  o.named = std::move(named);
  o.ties = std::move(ties);
  o.available_nat = 40.0;
  return o;
}

TEST(TrialScore, IsRightOnlyWhenTheMainEffectIsNamedFirstOrDeclaredInseparable) {
  EXPECT_TRUE(Hidden({effect::Id::kUnbalance}, {effect::Id::kUnbalance}).Right());
  EXPECT_TRUE(
      Hidden({effect::Id::kUnbalance}, {effect::Id::kShaftBow}, {effect::Id::kUnbalance}).Right());
  EXPECT_FALSE(
      Hidden({effect::Id::kUnbalance}, {effect::Id::kShaftBow, effect::Id::kUnbalance}).Right());
  EXPECT_FALSE(Hidden({effect::Id::kUnbalance}, {}).Right());
}

TEST(TrialScore, IsPartlyRightWhenAnyEffectReallyPresentIsNamed) {
  EXPECT_TRUE(Hidden({effect::Id::kUnbalance, effect::Id::kHysteresis}, {effect::Id::kHysteresis})
                  .Partly());
  EXPECT_FALSE(Hidden({effect::Id::kUnbalance, effect::Id::kHysteresis}, {effect::Id::kHysteresis})
                   .NamesAll());
  EXPECT_TRUE(Hidden({effect::Id::kUnbalance, effect::Id::kHysteresis},
                     {effect::Id::kHysteresis, effect::Id::kUnbalance})
                  .NamesAll());
  EXPECT_FALSE(Hidden({effect::Id::kUnbalance}, {effect::Id::kShaftBow}).Partly());
}

TEST(TrialScore, OfACleanRecordIsRightOnlyWhenNothingIsNamed) {
  EXPECT_TRUE(Hidden({}, {}).Right());
  EXPECT_FALSE(Hidden({}, {effect::Id::kUnbalance}).Right());
  TrialScore unknown = Hidden({}, {});
  unknown.verdict = "unknown";
  EXPECT_FALSE(unknown.Right());
}

TEST(TrialScore, OfSomethingOutsideTheVocabularyIsRightOnlyWhenCalledUnknown) {
  TrialScore o = Hidden({}, {});
  o.outside = "turbulence";
  EXPECT_FALSE(o.Right());
  o.verdict = "unknown";
  EXPECT_TRUE(o.Right());
  o = Hidden({}, {effect::Id::kUnbalance});
  o.outside = "turbulence";
  EXPECT_FALSE(o.Right());
}

TEST(ConfusionTable, HasARowForEveryTruthAndCountsTheFirstNamed) {
  const std::string table =
      ConfusionTable({Hidden({effect::Id::kUnbalance}, {effect::Id::kUnbalance}),
                      Hidden({effect::Id::kUnbalance}, {effect::Id::kUnbalance}),
                      Hidden({effect::Id::kUnbalance}, {effect::Id::kShaftBow}), Hidden({}, {})});
  EXPECT_NE(table.find("| unbalance | unbalance 2, shaft_bow 1 |"), std::string::npos) << table;
  EXPECT_NE(table.find("| (nothing) | none 1 |"), std::string::npos) << table;
}

TEST(Tables, KeepEffectsSizesAndCleanRecordsApart) {
  TrialScore faint = Hidden({effect::Id::kUnbalance}, {});
  faint.available_nat = 7.0;
  const std::string text =
      Tables({Hidden({effect::Id::kUnbalance}, {effect::Id::kUnbalance}), faint, Hidden({}, {})});
  EXPECT_NE(text.find("unbalance                       1/1         -     0/1"), std::string::npos)
      << text;
  EXPECT_NE(text.find("nothing hidden, called none: 1/1"), std::string::npos) << text;
}

TEST(Tables, CountPairsOfWhichTheRecordsHoldBothClearlyApart) {
  TrialScore both = Hidden({effect::Id::kUnbalance, effect::Id::kHysteresis},
                           {effect::Id::kUnbalance, effect::Id::kHysteresis});
  TrialScore missed =
      Hidden({effect::Id::kUnbalance, effect::Id::kHysteresis}, {effect::Id::kUnbalance});
  missed.missed = {{effect::Id::kHysteresis, 90.0}};
  TrialScore below = missed;
  below.missed = {{effect::Id::kHysteresis, 3.0}};
  TrialScore unknown = missed;
  unknown.missed = {{effect::Id::kHysteresis, std::nullopt}};
  TrialScore second = missed;
  second.named = {effect::Id::kShaftBow, effect::Id::kUnbalance};
  TrialScore neither = missed;
  neither.named = {effect::Id::kShaftBow};
  const std::string text = Tables({both, missed, below, unknown, second, neither});
  EXPECT_NE(text.find("main one named: 5/6, first: 4/6"), std::string::npos) << text;
  EXPECT_NE(text.find("all named: 1/6; where the records hold every one clearly: 1/5"),
            std::string::npos)
      << text;
}

diagnosis::DiagnosisReport Informed(effect::Id effect, double evidence_nat, bool named) {
  diagnosis::DiagnosisReport report;
  diagnosis::ReportCandidate& candidate = report.candidates.emplace_back();
  candidate.effect = effect::At(effect).name;
  candidate.evidence_nat = evidence_nat;
  if (named) report.causes.push_back({candidate.effect, ""});
  return report;
}

TrialScore Missed(double drawn) {
  TrialScore o = Hidden({effect::Id::kMisalignment}, {});
  o.verdict = "unknown";
  o.drawn = drawn;
  o.available_nat = 0.0;
  return o;
}

TEST(InformedDiagnosis,
     ThatDoesNotNameWhatTheRecordsHoldHasFailedAndTheTrialHasTheSizeOfWhatTheyHold) {
  for (const auto& [held, size] : {std::pair{2907.0, Size::kClear}, {18.0, Size::kModerate}}) {
    TrialScore o = Missed(0.5);
    AddInformedDiagnosis(Informed(effect::Id::kMisalignment, 0.0, false), held, o);
    EXPECT_TRUE(o.informed_failed);
    EXPECT_EQ(o.size(), size);
    EXPECT_FALSE(o.Right());
  }
}

TEST(InformedDiagnosis, ThatFindsNothingInRecordsThatHoldNothingHasNotFailed) {
  TrialScore o = Missed(1.0);
  AddInformedDiagnosis(Informed(effect::Id::kMisalignment, -0.6, false), 0.2, o);
  EXPECT_FALSE(o.informed_failed);
  EXPECT_EQ(o.size(), Size::kBelow);
}

TEST(InformedDiagnosis, ThatNamesTheEffectSaysItsSize) {
  TrialScore o = Missed(1.0);
  AddInformedDiagnosis(Informed(effect::Id::kMisalignment, 12.0, true), 40.0, o);
  EXPECT_FALSE(o.informed_failed);
  EXPECT_EQ(o.size(), Size::kModerate);
}

TEST(InformedDiagnosis, ThatLeavesSomethingIsNotBelievedWhereNothingElseSaysWhatTheRecordsHold) {
  TrialScore o = Missed(1.0);
  diagnosis::DiagnosisReport informed = Informed(effect::Id::kMisalignment, 0.0, false);
  informed.verdict = diagnosis::Verdict::kUnknown;
  AddInformedDiagnosis(informed, std::nullopt, o);
  EXPECT_TRUE(o.informed_failed);
  EXPECT_EQ(o.size(), Size::kClear);
  informed.verdict = diagnosis::Verdict::kNone;
  AddInformedDiagnosis(informed, std::nullopt, o);
  EXPECT_EQ(o.size(), Size::kBelow);
}

TEST(InformedDiagnosis, CountsOnlyEvidenceForWhatIsHidden) {
  TrialScore o = Missed(1.0);
  AddInformedDiagnosis(Informed(effect::Id::kSensorNoise, 300.0, true), 0.0, o);
  EXPECT_EQ(o.size(), Size::kBelow);
}

TEST(Tables, ListATrialWhoseInformedDiagnosisFailedAndCountItAsNotNamed) {
  TrialScore o = Missed(1.0);
  o.seed = 17328;
  AddInformedDiagnosis(Informed(effect::Id::kMisalignment, 0.0, false), 2907.0, o);
  const std::string text = Tables({o});
  EXPECT_NE(text.find("misalignment                    0/1         -       -       -"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("17328 misalignment (clear, the records hold 2907 nat)"), std::string::npos)
      << text;
}

TEST(Sizes, AreWhatTheRecordsHoldAndWhatDoesNotDecideIsBelowAll) {
  EXPECT_EQ(SizeOf(25.0), Size::kClear);
  EXPECT_EQ(SizeOf(24.9), Size::kModerate);
  EXPECT_EQ(SizeOf(9.9), Size::kFaint);
  EXPECT_EQ(SizeOf(0.99 * diagnosis::kDecisive), Size::kBelow);
}

}  // namespace
}  // namespace levitas::accuracy
