// What counts as a right, a partly right and a wrong answer of the diagnosis.

#include "benchmark/accuracy/scores.hpp"

#include <gtest/gtest.h>

namespace levitas::accuracy {
namespace {

TrialScore Hidden(std::vector<std::string> truth, std::vector<std::string> named,
                  std::vector<std::string> ties = {}) {
  TrialScore o;
  o.truth = std::move(truth);
  o.verdict = named.empty() ? "none" : "effect";
  o.named = std::move(named);
  o.ties = std::move(ties);
  o.available_nat = 40.0;
  return o;
}

TEST(TrialScore, IsRightOnlyWhenTheMainEffectIsNamedFirstOrDeclaredInseparable) {
  EXPECT_TRUE(Hidden({"unbalance"}, {"unbalance"}).Right());
  EXPECT_TRUE(Hidden({"unbalance"}, {"shaft_bow"}, {"unbalance"}).Right());
  EXPECT_FALSE(Hidden({"unbalance"}, {"shaft_bow", "unbalance"}).Right());
  EXPECT_FALSE(Hidden({"unbalance"}, {}).Right());
}

TEST(TrialScore, IsPartlyRightWhenAnyEffectReallyPresentIsNamed) {
  EXPECT_TRUE(Hidden({"unbalance", "hysteresis"}, {"hysteresis"}).Partly());
  EXPECT_FALSE(Hidden({"unbalance", "hysteresis"}, {"hysteresis"}).NamesAll());
  EXPECT_TRUE(Hidden({"unbalance", "hysteresis"}, {"hysteresis", "unbalance"}).NamesAll());
  EXPECT_FALSE(Hidden({"unbalance"}, {"shaft_bow"}).Partly());
}

TEST(TrialScore, OfACleanRecordIsRightOnlyWhenNothingIsNamed) {
  EXPECT_TRUE(Hidden({}, {}).Right());
  EXPECT_FALSE(Hidden({}, {"unbalance"}).Right());
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
  o = Hidden({}, {"unbalance"});
  o.outside = "turbulence";
  EXPECT_FALSE(o.Right());
}

TEST(ConfusionTable, HasARowForEveryTruthAndCountsTheFirstNamed) {
  const std::string table =
      ConfusionTable({Hidden({"unbalance"}, {"unbalance"}), Hidden({"unbalance"}, {"unbalance"}),
                      Hidden({"unbalance"}, {"shaft_bow"}), Hidden({}, {})});
  EXPECT_NE(table.find("| unbalance | unbalance 2, shaft_bow 1 |"), std::string::npos) << table;
  EXPECT_NE(table.find("| (nothing) | none 1 |"), std::string::npos) << table;
}

TEST(Tables, KeepEffectsSizesAndCleanRecordsApart) {
  TrialScore faint = Hidden({"unbalance"}, {});
  faint.available_nat = 7.0;
  const std::string text = Tables({Hidden({"unbalance"}, {"unbalance"}), faint, Hidden({}, {})});
  EXPECT_NE(text.find("unbalance                       1/1         -     0/1"), std::string::npos)
      << text;
  EXPECT_NE(text.find("nothing hidden, called none: 1/1"), std::string::npos) << text;
}

TEST(Tables, CountPairsOfWhichTheRecordsHoldBothClearlyApart) {
  TrialScore both = Hidden({"unbalance", "hysteresis"}, {"unbalance", "hysteresis"});
  TrialScore missed = Hidden({"unbalance", "hysteresis"}, {"unbalance"});
  missed.missed = {{"hysteresis", 90.0}};
  TrialScore below = missed;
  below.missed = {{"hysteresis", 3.0}};
  TrialScore unknown = missed;
  unknown.missed = {{"hysteresis", std::nullopt}};
  TrialScore second = missed;
  second.named = {"shaft_bow", "unbalance"};
  TrialScore neither = missed;
  neither.named = {"shaft_bow"};
  const std::string text = Tables({both, missed, below, unknown, second, neither});
  EXPECT_NE(text.find("main one named: 5/6, first: 4/6"), std::string::npos) << text;
  EXPECT_NE(text.find("all named: 1/6; where the records hold every one clearly: 1/5"),
            std::string::npos)
      << text;
}

diagnosis::DiagnosisReport Informed(const std::string& effect, double evidence_nat, bool named) {
  diagnosis::DiagnosisReport report;
  diagnosis::ReportCandidate& candidate = report.candidates.emplace_back();
  candidate.effect = effect;
  candidate.evidence_nat = evidence_nat;
  if (named) report.causes.push_back({effect, ""});
  return report;
}

TrialScore Missed(double drawn) {
  TrialScore o = Hidden({"misalignment"}, {});
  o.verdict = "unknown";
  o.drawn = drawn;
  o.available_nat = 0.0;
  return o;
}

TEST(InformedDiagnosis,
     ThatDoesNotNameWhatTheRecordsHoldHasFailedAndTheTrialHasTheSizeOfWhatTheyHold) {
  for (const auto& [held, size] : {std::pair{2907.0, Size::kClear}, {18.0, Size::kModerate}}) {
    TrialScore o = Missed(0.5);
    AddInformedDiagnosis(Informed("misalignment", 0.0, false), held, o);
    EXPECT_TRUE(o.informed_failed);
    EXPECT_EQ(o.size(), size);
    EXPECT_FALSE(o.Right());
  }
}

TEST(InformedDiagnosis, ThatFindsNothingInRecordsThatHoldNothingHasNotFailed) {
  TrialScore o = Missed(1.0);
  AddInformedDiagnosis(Informed("misalignment", -0.6, false), 0.2, o);
  EXPECT_FALSE(o.informed_failed);
  EXPECT_EQ(o.size(), Size::kBelow);
}

TEST(InformedDiagnosis, ThatNamesTheEffectSaysItsSize) {
  TrialScore o = Missed(1.0);
  AddInformedDiagnosis(Informed("misalignment", 12.0, true), 40.0, o);
  EXPECT_FALSE(o.informed_failed);
  EXPECT_EQ(o.size(), Size::kModerate);
}

TEST(InformedDiagnosis, ThatLeavesSomethingIsNotBelievedWhereNothingElseSaysWhatTheRecordsHold) {
  TrialScore o = Missed(1.0);
  diagnosis::DiagnosisReport informed = Informed("misalignment", 0.0, false);
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
  AddInformedDiagnosis(Informed("sensor_noise", 300.0, true), 0.0, o);
  EXPECT_EQ(o.size(), Size::kBelow);
}

TEST(Tables, ListATrialWhoseInformedDiagnosisFailedAndCountItAsNotNamed) {
  TrialScore o = Missed(1.0);
  o.seed = 17328;
  AddInformedDiagnosis(Informed("misalignment", 0.0, false), 2907.0, o);
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
