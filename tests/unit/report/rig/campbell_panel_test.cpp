#include "report/rig/campbell_panel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/rotational_speed.hpp"
#include "tests/unit/report/rig/shipped_rig.hpp"

namespace levitas::report {
namespace {

/// 40 Hz backward and 60 Hz forward, at every speed up to 100 Hz.
analysis::Campbell Flat() {
  const auto modes = [](double) {
    return std::vector<analysis::CampbellMode>{{40.0, 0.1, 0.0, 0.0}, {60.0, 0.2, 1.0, 0.0}};
  };
  return analysis::CampbellOf(modes, 2.0 * std::numbers::pi * 100.0, 24);
}

svg::Panel Panel() {
  return CampbellPanel(Flat(), {"title", 2.0 * std::numbers::pi * 80.0, 120.0});
}

TEST(CampbellPanel, PutsARingWhereAModeMeetsRotation) {
  const svg::Panel panel = Panel();
  const svg::Series* rings = test::Named(panel, "crossing of 1x");
  ASSERT_NE(rings, nullptr);
  ASSERT_EQ(rings->x.size(), 2U);
  EXPECT_NEAR(rings->x[0], 2400.0, 1e-3);
  EXPECT_NEAR(rings->x[1], 3600.0, 1e-3);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(rings->y[i], rings->x[i] / 60.0, 1e-6);
  EXPECT_TRUE(test::HasNote(panel, "2400 rpm B"));
  EXPECT_TRUE(test::HasNote(panel, "3600 rpm F"));
}

TEST(CampbellPanel, TellsTheTwoWhirlsApartWithoutColour) {
  const svg::Panel panel = Panel();
  const svg::Series* forward = test::Named(panel, "forward whirl");
  const svg::Series* backward = test::Named(panel, "backward whirl");
  ASSERT_NE(forward, nullptr);
  ASSERT_NE(backward, nullptr);
  EXPECT_NE(forward->mark, backward->mark);
  for (const double hz : forward->y) EXPECT_DOUBLE_EQ(hz, 60.0);
  for (const double hz : backward->y) EXPECT_DOUBLE_EQ(hz, 40.0);
  std::size_t dashed = 0;
  for (const auto& series : panel.series) {
    if (series.width > 1.5 && !series.dashes.empty()) ++dashed;
  }
  EXPECT_EQ(dashed, 1U);  // the backward one
}

TEST(CampbellPanel, MarksTheRatedSpeedAndRotation) {
  const svg::Panel panel = Panel();
  EXPECT_TRUE(test::HasNote(panel, "rated 4800 rpm"));
  const svg::Series* rotation = test::Named(panel, "1x");
  ASSERT_NE(rotation, nullptr);
  EXPECT_NEAR(rotation->y.back(), rotation->x.back() / 60.0, 1e-9);
}

TEST(DampingPanel, ShadesWhatGrowsOnlyWhereSomethingDoes) {
  const CampbellLook look{"title", 300.0, 0.0};
  EXPECT_EQ(test::Named(DampingPanel(Flat(), look), "grows"), nullptr);
  analysis::Campbell growing = Flat();
  growing.speeds[3].modes[0].damping_ratio = -0.01;
  const svg::Panel panel = DampingPanel(growing, look);
  EXPECT_NE(test::Named(panel, "grows"), nullptr);
  EXPECT_LT(panel.y_range->low, -0.01);
}

}  // namespace
}  // namespace levitas::report
