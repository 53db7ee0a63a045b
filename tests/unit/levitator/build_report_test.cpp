// The report of a levitator names the place of every cause that its diagnosis can find.

#include "diagnosis/levitator/build_report.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "diagnosis/levitator/causes.hpp"
#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

/// A result without a cause.
LevitatorResult Healthy() {
  const config::RigFile rig = test::LevitatorFile();
  LevitatorResult result;
  result.common.view = std::make_shared<const diagnosis::RigView>(rig.numbers, rig.plant);
  result.common.own_words.emplace();
  result.common.answer.remainder.channels.resize(1);
  return result;
}

TEST(LevitatorReport, SaysThePlaceOfEveryCauseAlsoOfThoseNoRotorHas) {
  for (std::size_t c = 0; c < Causes().size(); ++c) {
    LevitatorResult result = Healthy();
    result.found.causes = {c};
    diagnosis::Hypothesis cause;
    cause.effect = Causes()[c].effect;
    cause.place = Causes()[c].where;
    result.common.answer.verdict = diagnosis::Verdict::kEffect;
    result.common.answer.causes = {cause};
    const diagnosis::DiagnosisReport report = BuildReport(result);
    ASSERT_EQ(report.causes.size(), 1U);
    EXPECT_EQ(report.causes[0].effect, cause.effect);
    EXPECT_EQ(report.place, Table()[Causes()[c].moves.front()].place) << cause.effect;
    EXPECT_NE(report.place, "") << cause.effect;
  }
}

TEST(LevitatorReport, OfAHealthyRigHasNoPlace) { EXPECT_EQ(BuildReport(Healthy()).place, ""); }

}  // namespace
}  // namespace levitas::levitator
