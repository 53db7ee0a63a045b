#include "report/identification/law_files.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <nlohmann/json.hpp>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/report/identification/written.hpp"

namespace levitas::report {
namespace {

using identification::LawFit;

/// A direct gain and one real pole.
LawFit OnePole(const char* name) {
  LawFit fit;
  fit.name = name;
  fit.options.lowest_hz = 5.0;
  fit.options.highest_hz = 500.0;
  fit.law.direct = 2.0;
  fit.law.poles = {{.place = {-100.0, 0.0}, .residue = {30.0, 0.0}}};
  fit.fit_percent = 99.5;
  fit.lines = 77;
  fit.tried = {{.order = 1, .fit_percent = 99.5}, {.order = 2, .fit_percent = 99.6}};
  fit.measured_hz = {10.0, 100.0};
  fit.measured = {{2.0, -0.1}, {2.0, -0.01}};
  return fit;
}

TEST(LawJson, HoldsEachControllerWithItsPolesAndTheOrdersThatWereTried) {
  const auto json = LawJson({OnePole("x"), OnePole("y")});
  ASSERT_EQ(json["controllers"].size(), 2U);
  const auto& one = json["controllers"][1];
  EXPECT_EQ(one["name"], "y");
  EXPECT_EQ(one["order"], 1);
  EXPECT_EQ(one["direct"], 2.0);
  EXPECT_EQ(one["lines"], 77);
  EXPECT_EQ(one["lowest_hz"], 5.0);
  EXPECT_EQ(one["poles"][0]["real"], -100.0);
  EXPECT_EQ(one["poles"][0]["residue_real"], 30.0);
  ASSERT_EQ(one["orders_tried"].size(), 2U);
  EXPECT_EQ(one["orders_tried"][1]["order"], 2);
}

TEST(LawJson, SaysInWhichDomainThePolesLie) {
  LawFit fit = OnePole("x");
  EXPECT_FALSE(LawJson({fit})["controllers"][0]["discrete"]);
  fit.options.domain = identification::LawDomain::kDiscrete;
  EXPECT_TRUE(LawJson({fit})["controllers"][0]["discrete"]);
}

TEST(LawPicture, HasAColumnPerControllerWithMagnitudeAndPhase) {
  const levitas::test::ScratchFolder folder;
  WriteLawPicture(folder / "law.svg", {OnePole("left"), OnePole("right")});
  const std::string svg = test::Content(folder / "law.svg");
  EXPECT_EQ(test::Count(svg, ">phase, degrees<"), 2U);
  EXPECT_EQ(test::Count(svg, ">output per input<"), 2U);
  EXPECT_EQ(test::Count(svg, ">left<"), 2U);
  EXPECT_EQ(test::Count(svg, ">right<"), 2U);
}

}  // namespace
}  // namespace levitas::report
