// What counts as a right, a partly right and a wrong answer of the diagnosis.

#include "trials/scores.hpp"

#include <gtest/gtest.h>

namespace levitas::trials {
namespace {

Outcome Hidden(std::vector<std::string> truth, std::vector<std::string> named,
               std::vector<std::string> ties = {}) {
  Outcome o;
  o.truth = std::move(truth);
  o.verdict = named.empty() ? "none" : "effect";
  o.named = std::move(named);
  o.ties = std::move(ties);
  o.available_nat = 40.0;
  return o;
}

TEST(Outcome, IsRightOnlyWhenTheMainEffectIsNamedFirstOrDeclaredInseparable) {
  EXPECT_TRUE(Hidden({"unbalance"}, {"unbalance"}).Right());
  EXPECT_TRUE(Hidden({"unbalance"}, {"shaft_bow"}, {"unbalance"}).Right());
  EXPECT_FALSE(Hidden({"unbalance"}, {"shaft_bow", "unbalance"}).Right());
  EXPECT_FALSE(Hidden({"unbalance"}, {}).Right());
}

TEST(Outcome, IsPartlyRightWhenAnyEffectReallyPresentIsNamed) {
  EXPECT_TRUE(Hidden({"unbalance", "hysteresis"}, {"hysteresis"}).Partly());
  EXPECT_FALSE(Hidden({"unbalance", "hysteresis"}, {"hysteresis"}).NamesAll());
  EXPECT_TRUE(Hidden({"unbalance", "hysteresis"}, {"hysteresis", "unbalance"}).NamesAll());
  EXPECT_FALSE(Hidden({"unbalance"}, {"shaft_bow"}).Partly());
}

TEST(Outcome, OfACleanRecordIsRightOnlyWhenNothingIsNamed) {
  EXPECT_TRUE(Hidden({}, {}).Right());
  EXPECT_FALSE(Hidden({}, {"unbalance"}).Right());
  Outcome unknown = Hidden({}, {});
  unknown.verdict = "unknown";
  EXPECT_FALSE(unknown.Right());
}

TEST(Outcome, OfSomethingOutsideTheVocabularyIsRightOnlyWhenCalledUnknown) {
  Outcome o = Hidden({}, {});
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
  Outcome faint = Hidden({"unbalance"}, {});
  faint.available_nat = 7.0;
  const std::string text = Tables({Hidden({"unbalance"}, {"unbalance"}), faint, Hidden({}, {})});
  EXPECT_NE(text.find("unbalance                       1/1         -     0/1"), std::string::npos)
      << text;
  EXPECT_NE(text.find("nothing hidden, called none: 1/1"), std::string::npos) << text;
}

TEST(Sizes, AreWhatTheRecordsHoldAndWhatDoesNotDecideIsBelowAll) {
  EXPECT_EQ(SizeOf(25.0), Size::kClear);
  EXPECT_EQ(SizeOf(24.9), Size::kModerate);
  EXPECT_EQ(SizeOf(9.9), Size::kFaint);
  EXPECT_EQ(SizeOf(0.99 * diagnosis::kDecisive), Size::kBelow);
}

}  // namespace
}  // namespace levitas::trials
