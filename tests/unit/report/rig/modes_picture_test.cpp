#include "report/rig/modes_picture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/unit/report/rig/shipped_rig.hpp"

namespace levitas::report {
namespace {

using testing::HasSubstr;
using testing::Not;

svg::Figure Picture(const configuration::RigFile& rig) {
  const auto campbell =
      analysis::FreeCampbell(rig.plant, 1.25 * rig.numbers.max_speed_rad_per_s, 4);
  if (!rig.plant.shafts.empty()) return ModesPicture(rig, campbell, std::nullopt);
  return ModesPicture(rig, campbell, analysis::FiguresOf(rig.plant, 4));
}

TEST(ModesPicture, NamesLoadsCentreAndInertia) {
  const auto rig = test::Rig("flexible_rotor");
  const auto figures = analysis::FiguresOf(rig.plant, 4);
  const svg::Figure picture = Picture(rig);
  ASSERT_EQ(picture.panels.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(test::HasNote(
        picture.panels[1],
        fmt::format("{} carries {:.2f} N", figures.loads[i].bearing, *figures.loads[i].load_n)));
  }
  EXPECT_TRUE(test::HasNote(picture.panels[1], fmt::format("{:.1f} mm", 1e3 * figures.centre_z_m)));
  EXPECT_THAT(picture.lines.at(0), HasSubstr("inertia"));
}

TEST(ModesPicture, DrawsEveryModeShapeWithinThePanel) {
  const svg::Figure picture = Picture(test::Rig("flexible_rotor"));
  std::size_t shapes = 0;
  for (const auto& series : picture.panels[1].series) {
    if (!series.name.starts_with("mode ")) continue;
    ++shapes;
    for (const double y : series.y) EXPECT_LE(std::abs(y), 1.0);
  }
  EXPECT_EQ(shapes, 4U);
}

TEST(ModesPicture, OfARigWithoutBendingModesSaysSo) {
  const svg::Figure picture = Picture(test::Rig("one_axis"));
  EXPECT_TRUE(test::HasNote(picture.panels[0], "no bending mode"));
  const std::string drawn = svg::Draw(picture);
  EXPECT_THAT(drawn, Not(HasSubstr("nan")));
  EXPECT_THAT(drawn, Not(HasSubstr("inf")));
}

TEST(ModesPicture, OfEveryShippedRigIsADrawing) {
  for (const char* name : {"flexible_rotor", "ufu_rig", "turbomolecular_pump", "geared_rotor_8dof",
                           "two_magnet_levitator", "rao_geared_pair"}) {
    const std::string drawn = svg::Draw(Picture(test::Rig(name)));
    EXPECT_THAT(drawn, Not(HasSubstr("nan"))) << name;
    EXPECT_TRUE(drawn.ends_with("</svg>\n")) << name;
  }
}

TEST(ModesPicture, ShowsNamesOfOthersAsText) {
  auto rig = test::Rig("flexible_rotor");
  rig.numbers.name = "<script>alert(1)</script>";
  rig.plant.bearings[0].name = "a</text><b>";
  const std::string drawn = svg::Draw(Picture(rig));
  EXPECT_THAT(drawn, HasSubstr("&lt;script&gt;"));
  EXPECT_THAT(drawn, Not(HasSubstr("<script")));
  EXPECT_THAT(drawn, Not(HasSubstr("<b>")));
}

}  // namespace
}  // namespace levitas::report
