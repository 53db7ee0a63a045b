#include "report/session/comparison_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/problem.hpp"

namespace levitas::report {
namespace {

using testing::HasSubstr;
using testing::Not;

AtSpeed Turning(double radius_m) {
  AtSpeed at;
  at.found.held = true;
  at.found.speed_rad_per_s = 100.0;
  at.found.largest_radius_m = {radius_m};
  for (auto* axes : {&at.found.position_m, &at.found.current_a}) axes->assign(2, {0.0, {radius_m}});
  Orbit orbit;
  for (int i = 0; i < 100; ++i) {
    orbit.x_m.push_back(radius_m * std::cos(0.1 * i));
    orbit.y_m.push_back(radius_m * std::sin(0.1 * i));
  }
  at.orbits = {orbit};
  return at;
}

/// Two records at two speeds; the second has no second speed.
Comparison Two() {
  Comparison c;
  c.channels = {"de_x", "de_y"};
  c.bearings = {"de"};
  c.orders = {1.0};
  c.speeds_rad_per_s = {100.0, 200.0};
  c.clearance_m = {190e-6};
  c.records.push_back({"pid", "pid.lcm", "rig", "law", "", {Turning(10e-6), Turning(20e-6)}, {}});
  c.records.push_back({"h<8", "h.lcm", "rig", "law", "", {Turning(5e-6), std::nullopt}, {}});
  c.records[0].over_speed = {Turning(10e-6).found, Turning(20e-6).found};
  return c;
}

TEST(ComparisonPictures, ShowTheOrbitsOfAllSpeedsOnOneScale) {
  const auto pictures = ComparisonPictures(Two(), 0.0);
  const auto& panels = pictures.at(0).figure.panels;
  ASSERT_EQ(panels.size(), 2U);
  EXPECT_EQ(panels[0].x_range->high, panels[1].x_range->high);
  EXPECT_EQ(panels[0].x_range->high, panels[0].y_range->high);
  EXPECT_GE(panels[0].x_range->high, 20.0);
  EXPECT_EQ(panels[0].series.size(), 2U);
  EXPECT_EQ(panels[1].series.size(), 1U);  // of the record that has the speed
}

TEST(ComparisonPictures, DrawTheCircleOfTheObjectiveOnlyWhereOneIsGiven) {
  EXPECT_EQ(ComparisonPictures(Two(), 0.0).at(0).figure.panels[0].series.size(), 2U);
  const auto pictures = ComparisonPictures(Two(), 36.0);
  const auto& panel = pictures.at(0).figure.panels[0];
  ASSERT_EQ(panel.series.size(), 3U);
  for (std::size_t i = 0; i < panel.series[0].x.size(); ++i) {
    EXPECT_NEAR(std::hypot(panel.series[0].x[i], panel.series[0].y[i]), 36.0, 1e-9);  // rounding
  }
  EXPECT_GE(panel.x_range->high, 36.0);
}

TEST(ComparisonPage, SaysOfEachRecordWhetherItIsInsideTheCircle) {
  const std::string page = ComparisonPage(Two(), "table", 15.0);
  EXPECT_THAT(page, HasSubstr("pid: largest radius 20.0 µm at 1910 rpm, outside"));
  EXPECT_THAT(page, HasSubstr("h&lt;8: largest radius 5.0 µm at 955 rpm, inside"));
  EXPECT_THAT(ComparisonPage(Two(), "table", 0.0), Not(HasSubstr("largest radius")));
}

TEST(ComparisonPage, ShowsTextOfOthersAsText) {
  Comparison c = Two();
  c.records[0].controller = "<script>alert(1)</script>";
  const std::string page = ComparisonPage(c, "a <b>", 0.0);
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("a &lt;b&gt;"));
}

RecordToCompare Standing(const std::vector<std::string>& channels, std::size_t bearings) {
  RecordToCompare record;
  record.path = "r" + std::to_string(channels.size());
  record.rig.numbers.channels = channels;
  record.rig.numbers.bearings.assign(bearings, "b");
  auto& r = record.recording;
  r.period_ns = 100'000;
  r.channels = channels;
  for (std::uint64_t n = 0; n < 3000; ++n) r.cycle.push_back(n);
  r.levitated.assign(3000, 1);
  r.speed_rad_per_s.assign(3000, 0.0);
  r.angle_rad.assign(3000, 0.0);
  for (auto* columns : {&r.position_m, &r.current_a}) {
    columns->assign(channels.size(), session::Column(3000, -2e-6));
  }
  r.excitation_a.assign(channels.size(), {});
  r.excitation_m.assign(channels.size(), {});
  return record;
}

TEST(Compare, TakesARigOfOneAxisAndRefusesItBesideOneOfTwo) {
  const Comparison one = Compare({Standing({"mass_x"}, 1)}, {});
  ASSERT_TRUE(one.records.at(0).speeds.at(0));
  EXPECT_NEAR(one.records[0].speeds[0]->found.largest_radius_m.at(0), 2e-6, 1e-15);
  EXPECT_THROW(
      static_cast<void>(Compare({Standing({"mass_x"}, 1), Standing({"de_x", "de_y"}, 1)}, {})),
      BadInput);
}

}  // namespace
}  // namespace levitas::report
