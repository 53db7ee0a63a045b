#include "report/session/pictures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "tests/unit/report/session/whirling_rotor.hpp"

namespace levitas::report {
namespace {

using test::WhirlingRotor;
using testing::Contains;
using testing::Not;

std::vector<std::string> Names(const std::vector<NamedPicture>& pictures) {
  std::vector<std::string> names;
  for (const NamedPicture& picture : pictures) names.push_back(picture.name);
  return names;
}

const svg::Panel& PanelOf(const std::vector<NamedPicture>& pictures, const std::string& name) {
  for (const NamedPicture& picture : pictures) {
    if (picture.name == name) return picture.figure.panels.at(0);
  }
  throw std::out_of_range("no picture " + name);
}

TEST(Pictures, HaveNamesOfTheirOwnAndWordsForThoseWhoDoNotSeeThem) {
  const auto pictures = Pictures(WhirlingRotor(), {});
  const auto names = Names(pictures);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const NamedPicture& picture : pictures) {
    EXPECT_GT(picture.caption.size(), 20U) << picture.name;
    EXPECT_NE(svg::Draw(picture.figure).find("</svg>"), std::string::npos);
  }
}

TEST(Pictures, ShowARunUpOnlyOfARotorThatRanUp) {
  const auto turning = Names(Pictures(WhirlingRotor(), {}));
  EXPECT_THAT(turning, Contains("bode_de"));
  EXPECT_THAT(turning, Contains("waterfall_de"));
  test::Whirl standing;
  standing.top_rad_per_s = 0.0;
  const auto names = Names(Pictures(WhirlingRotor(standing), {}));
  EXPECT_THAT(names, Not(Contains("bode_de")));
  EXPECT_THAT(names, Not(Contains("waterfall_de")));
  EXPECT_THAT(names, Contains("orbit_de"));
}

TEST(OrbitPictures, DrawTheOrbitInsideTheClearanceCircle) {
  const Recording r = WhirlingRotor();
  const auto pictures = OrbitPictures(r, {r.top_speed_rad_per_s});
  const svg::Panel& panel = PanelOf(pictures, "orbit_de");
  const svg::Series& clearance = panel.series.front();
  for (std::size_t i = 0; i < clearance.x.size(); ++i) {
    EXPECT_NEAR(std::hypot(clearance.x[i], clearance.y[i]), 190.0, 1e-9);  // rounding
  }
  const svg::Series& orbit = panel.series.back();
  EXPECT_EQ(orbit.name, "3820 rpm");  // 400 rad/s
  for (std::size_t i = 0; i < orbit.x.size(); ++i) {
    // Single precision of 30 um: 2e-6 um.
    EXPECT_NEAR(std::hypot(orbit.x[i] - 20.0, orbit.y[i]), 10.0, 1e-4);
  }
}

TEST(OrbitPictures, ShowTheWayRoundAndWhereTheMarkPasses) {
  const Recording r = WhirlingRotor();
  const auto pictures = OrbitPictures(r, {r.top_speed_rad_per_s});
  const svg::Panel& panel = PanelOf(pictures, "orbit_enlarged_de");
  ASSERT_EQ(panel.series.size(), 3U);
  const svg::Series& dots = panel.series[1];
  ASSERT_GE(dots.x.size(), 1U);
  const double step = 10.0 * r.top_speed_rad_per_s * r.rig.period_s();
  for (std::size_t i = 0; i < dots.x.size(); ++i) {
    EXPECT_NEAR(dots.x[i], 20.0 + 10.0 * std::cos(test::kLeadRad), step);
    EXPECT_NEAR(dots.y[i], 10.0 * std::sin(test::kLeadRad), step);
  }
  // Forward: from the middle of the head's base to its tip it turns from +x towards +y.
  const svg::Series& arrow = panel.series[2];
  const double tail_x = 0.5 * (arrow.x[1] + arrow.x[2]) - 20.0;
  const double tail_y = 0.5 * (arrow.y[1] + arrow.y[2]);
  EXPECT_GT(tail_x * arrow.y[0] - tail_y * (arrow.x[0] - 20.0), 0.0);
}

TEST(OrbitPictures, NeverJoinWhatLiesBesideAGap) {
  Recording r = WhirlingRotor();
  r.cycle.back() += 7;  // the last sample stands alone
  const auto pictures = OrbitPictures(r, {r.top_speed_rad_per_s});
  EXPECT_EQ(PanelOf(pictures, "orbit_de").series.back().x.size(), 1U);
}

TEST(TimePictures, JudgeZonesOfTheLevitatedRotorOnly) {
  Recording r = WhirlingRotor();
  for (std::size_t i = 0; i < r.size() / 2; ++i) {  // lies in its touchdown bearing
    r.levitated[i] = false;
    r.position_m[0][i] = 190e-6F;
  }
  const auto pictures = TimePictures(r);
  const svg::Series& zones = PanelOf(pictures, "zones").series.front();
  EXPECT_TRUE(std::isnan(zones.y.front()));
  // 20 um off the centre and 10 um of whirl in 190 um, within single precision.
  EXPECT_NEAR(zones.y.back(), 30.0 / 190.0, 1e-3);
  const svg::Series& distance = PanelOf(pictures, "distance").series.front();
  EXPECT_NEAR(distance.y.front(), 190.0, 0.3);  // y is within 10 um: hypot(190, 10)
}

TEST(TimePictures, KeepTheLargestValueOfEveryStretch) {
  Recording r = WhirlingRotor();
  r.position_m[0][12'345] = 150e-6F;  // one sample of 40,000
  const auto pictures = TimePictures(r);
  const auto& y = PanelOf(pictures, "distance").series.front().y;
  EXPECT_GE(*std::max_element(y.begin(), y.end()), 149.99);  // single precision
}

TEST(Pictures, OfARigWithOneAxisAreDrawnWithTheOtherAtRest) {
  Recording r = WhirlingRotor();
  r.rig.channels = {"x"};
  std::fill(r.position_m[1].begin(), r.position_m[1].end(), 0.0F);
  const auto pictures = Pictures(r, {});
  // One axis has two edges, and the limits are two lines.
  EXPECT_EQ(PanelOf(pictures, "currents_de").series.size(), 4U);
  for (const double y : PanelOf(pictures, "orbit_de").series.back().y) EXPECT_EQ(y, 0.0);
}

TEST(ChosenSpeeds, AreStandingTheWorstAndTheTop) {
  Recording r = WhirlingRotor();
  // Three times the whirl about 200 rad/s, which is passed at half of the ramp.
  for (std::size_t i = 14'000; i < 16'000; ++i) {
    r.position_m[0][i] = 3.0F * (r.position_m[0][i] - 20e-6F);
    r.position_m[1][i] *= 3.0F;
  }
  const auto speeds = ChosenSpeeds(r, Synchronous(r));
  ASSERT_EQ(speeds.size(), 3U);
  EXPECT_EQ(speeds[0], 0.0);
  EXPECT_NEAR(speeds[1], 200.0, 20.0);  // somewhere in the stretch
  EXPECT_EQ(speeds[2], 400.0);
}

TEST(Waterfall, HasItsLineOfTheFirstOrderAtTheSpeed) {
  const Recording r = WhirlingRotor();
  const auto pictures = RunUpPictures(r, Synchronous(r));
  const svg::Panel& panel = PanelOf(pictures, "waterfall_de");
  // The fastest spectrum is drawn first, behind four lines of orders.
  const svg::Series& fastest = panel.series.at(4);
  const auto peak = std::max_element(fastest.y.begin(), fastest.y.end()) - fastest.y.begin();
  const double base_rpm = *std::min_element(fastest.y.begin(), fastest.y.end());
  // The speed changes by 54 rad/s, 9 Hz, within the spectrum's 0.4 s.
  EXPECT_NEAR(fastest.x.at(static_cast<std::size_t>(peak)), base_rpm / 60.0, 9.0);
}

}  // namespace
}  // namespace levitas::report
