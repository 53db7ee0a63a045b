#include "report/rig/campbell_panel.hpp"

#include <gtest/gtest.h>

#include <array>
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

/// Left, low, right, high of a text in pixels of a panel of 380 by 280.
std::array<double, 4> Pixels(const svg::Note& note, const svg::Panel& panel) {
  const double x = 380.0 * note.x / panel.x_range->high + note.right_px;
  const double y = 280.0 * note.y / panel.y_range->high - note.down_px;
  const double wide = 6.0 * static_cast<double>(note.text.size());
  const double left = note.anchor == svg::Anchor::kStart ? x : x - wide;
  return {left, y - 5.5, left + wide, y + 5.5};
}

TEST(CampbellPanel, PutsNoTextOverAnotherOrOverALine) {
  const auto rig = test::Rig("geared_rotor_12dof");
  const auto campbell =
      analysis::FreeCampbell(rig.plant, 1.25 * rig.numbers.max_speed_rad_per_s, 4);
  const svg::Panel panel = CampbellPanel(campbell, {"title", 200.0, 480.0});
  ASSERT_GT(campbell.crossings.size(), 10U);
  ASSERT_GT(panel.notes.size(), 6U);
  for (std::size_t i = 0; i < panel.notes.size(); ++i) {
    const auto a = Pixels(panel.notes[i], panel);
    for (std::size_t k = 0; k < i; ++k) {
      const auto b = Pixels(panel.notes[k], panel);
      EXPECT_FALSE(a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3])
          << panel.notes[i].text << " over " << panel.notes[k].text;
    }
    if (i == 0) continue;  // that of the rated speed stands at its own line
    for (const svg::Series& line : panel.series) {
      if (line.width <= 0.0) continue;
      for (std::size_t p = 1; p < line.x.size(); ++p) {
        for (double share = 0.0; share <= 1.0; share += 1.0 / 512.0) {
          const double at_x = line.x[p - 1] + share * (line.x[p] - line.x[p - 1]);
          const double at_y = line.y[p - 1] + share * (line.y[p] - line.y[p - 1]);
          const double x = 380.0 * at_x / panel.x_range->high;
          const double y = 280.0 * at_y / panel.y_range->high;
          ASSERT_FALSE(x > a[0] && x < a[2] && y > a[1] && y < a[3]) << panel.notes[i].text;
        }
      }
    }
  }
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
