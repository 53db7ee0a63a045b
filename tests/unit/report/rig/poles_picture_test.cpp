#include "report/rig/poles_picture.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/unit/report/rig/shipped_rig.hpp"

namespace levitas::report {
namespace {

svg::Figure Picture(double gain, double speed_rad_per_s) {
  const auto rig = test::Rig("flexible_rotor");
  auto law = test::Law("flexible_rotor", rig);
  for (auto& axis : law.axes) axis.kp_a_per_m *= gain;
  const double rated = rig.numbers.max_speed_rad_per_s;
  return PolesPicture({analysis::ClosedLoopPoles(rig.plant, law, speed_rad_per_s)},
                      analysis::LevitatedCampbell(rig.plant, law, 1.25 * rated),
                      {"title", 1000.0, rated});
}

std::size_t Drawn(const svg::Panel& panel, svg::Mark mark, bool right) {
  std::size_t count = 0;
  for (const auto& series : panel.series) {
    if (series.mark != mark) continue;
    for (const double re : series.x) count += (re > 0.0) == right ? 1U : 0U;
  }
  return count;
}

TEST(PolesPicture, HasNothingRightOfTheAxisOfALoopThatIsStable) {
  const svg::Panel plane = Picture(1.0, 300.0).panels[0];
  for (const auto mark : {svg::Mark::kUp, svg::Mark::kDown, svg::Mark::kRing}) {
    EXPECT_EQ(Drawn(plane, mark, true), 0U);
  }
  EXPECT_GT(Drawn(plane, svg::Mark::kUp, false), 2U);
  EXPECT_GT(Drawn(plane, svg::Mark::kDown, false), 2U);
}

TEST(PolesPicture, ShowsAPoleThatGrowsWithinThePanel) {
  const svg::Panel plane = Picture(0.3, 0.0).panels[0];
  EXPECT_GT(Drawn(plane, svg::Mark::kRing, true), 0U);
  for (const auto& series : plane.series) {
    if (series.mark != svg::Mark::kRing) continue;
    for (const double re : series.x) EXPECT_LT(re, plane.x_range->high);
  }
}

TEST(PolesPicture, AtRestNamesNoDirection) {
  const svg::Panel plane = Picture(1.0, 0.0).panels[0];
  EXPECT_EQ(Drawn(plane, svg::Mark::kUp, false), 0U);
  EXPECT_EQ(Drawn(plane, svg::Mark::kDown, false), 0U);
}

TEST(PolesPicture, HasNoNumberThatIsNone) {
  for (const double gain : {0.3, 1.0}) {
    EXPECT_THAT(svg::Draw(Picture(gain, 300.0)), testing::Not(testing::HasSubstr("nan")));
  }
}

}  // namespace
}  // namespace levitas::report
