#include "report/rig/margins_picture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/speed_sweep.hpp"
#include "tests/unit/report/rig/shipped_rig.hpp"

namespace levitas::report {
namespace {

LoopAtSpeed Loop(double gain = 1.0) {
  const auto rig = test::Rig("flexible_rotor");
  auto law = test::Law("flexible_rotor", rig);
  for (auto& axis : law.axes) axis.kp_a_per_m *= gain;
  return {analysis::SensitivityPeaks(rig.plant, law, 0.0), analysis::CurvesOf(rig.plant, law, 0.0)};
}

const std::vector<std::string> kChannels{"de_x", "de_y", "nde_x", "nde_y"};

TEST(SensitivityPanel, HasTheZonesOfTheStandard) {
  const svg::Panel panel = SensitivityPanel(Loop(), kChannels);
  std::set<double> levels;
  for (const auto& series : panel.series) {
    if (series.x.size() == 2 && series.y[0] == series.y[1]) levels.insert(series.y[0]);
  }
  EXPECT_EQ(levels, (std::set<double>{3.0, 4.0, 5.0}));
  // What is graded A by the library lies below the first of them, and so on.
  EXPECT_EQ(analysis::ZoneOf(std::nextafter(3.0, 0.0)), analysis::Zone::kA);
  EXPECT_EQ(analysis::ZoneOf(3.0), analysis::Zone::kB);
  for (const char* zone : {"zone B from 3", "zone C from 4", "zone D from 5"}) {
    EXPECT_TRUE(test::HasNote(panel, zone)) << zone;
  }
}

TEST(SensitivityPanel, MarksThePeakThatTheCommandPrints) {
  const LoopAtSpeed loop = Loop();
  const svg::Panel panel = SensitivityPanel(loop, kChannels);
  for (std::size_t i = 0; i < kChannels.size(); ++i) {
    const svg::Series* line = test::Named(panel, kChannels[i]);
    ASSERT_NE(line, nullptr);
    double highest = 0.0;
    for (const double y : line->y) highest = std::max(highest, y);
    EXPECT_NEAR(highest, loop.peaks.axes[i].peak, 0.01 * loop.peaks.axes[i].peak);
  }
  EXPECT_THAT(panel.title, testing::HasSubstr("zone"));
}

TEST(NyquistPanel, DrawsCirclesOnWhichTheSensitivityIsThatOfAZone) {
  const svg::Panel panel = NyquistPanel(Loop(), kChannels);
  std::set<int> found;
  for (const auto& series : panel.series) {
    if (series.fill.empty()) continue;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const double sensitivity = 1.0 / std::hypot(1.0 + series.x[i], series.y[i]);
      EXPECT_NEAR(sensitivity, std::round(sensitivity), 1e-9);
      found.insert(static_cast<int>(std::lround(sensitivity)));
    }
  }
  EXPECT_EQ(found, (std::set<int>{3, 4, 5}));
  EXPECT_TRUE(panel.same_scale);
}

TEST(NyquistPanel, NamesPeakAndMarginsWithTheirFrequencies) {
  const LoopAtSpeed loop = Loop();
  const svg::Panel panel = NyquistPanel(loop, kChannels);
  const auto& worst = loop.peaks.axes[analysis::WorstAxis(loop.peaks)];
  ASSERT_TRUE(worst.margins.phase_at_hz && worst.margins.gain_up && worst.margins.gain_down);
  EXPECT_TRUE(
      test::HasNote(panel, fmt::format("|S| {:.2f}: {:.1f} Hz", worst.peak, worst.frequency_hz)));
  EXPECT_TRUE(test::HasNote(panel, fmt::format("phase {:.0f} degrees: {:.1f} Hz",
                                               *worst.margins.phase_rad * 180.0 / std::acos(-1.0),
                                               *worst.margins.phase_at_hz)));
  // Rings: on the unit circle, and on the negative real axis at 1/gain (to the grid: a percent).
  const auto rings_at = [&](auto condition) {
    return std::ranges::count_if(panel.series, [&](const svg::Series& series) {
      return series.mark == svg::Mark::kRing && condition(series.x[0], series.y[0]);
    });
  };
  EXPECT_GE(rings_at([](double x, double y) { return std::abs(std::hypot(x, y) - 1.0) < 0.02; }),
            1);
  for (const double gain : {*worst.margins.gain_up, *worst.margins.gain_down}) {
    EXPECT_EQ(rings_at([&](double x, double y) {
                return std::abs(x + 1.0 / gain) < 0.02 / gain && std::abs(y) < 0.02;
              }),
              1)
        << gain;
  }
}

TEST(NyquistPanel, PutsNoTextOverAnother) {
  const svg::Panel panel = NyquistPanel(Loop(), kChannels);
  std::vector<double> heights;
  for (const svg::Note& note : panel.notes) {
    if (note.text != "-1") heights.push_back(note.y);
  }
  ASSERT_GE(heights.size(), 4U);
  std::ranges::sort(heights);
  // 4 units are some 279 pixels, letters are 11 high.
  for (std::size_t i = 1; i < heights.size(); ++i) EXPECT_GT(heights[i] - heights[i - 1], 0.17);
}

TEST(NyquistPanel, CrossesNoLineThatLeadsToAPlace) {
  const svg::Panel panel = NyquistPanel(Loop(), kChannels);
  std::vector<svg::Series> leads;
  for (const svg::Series& series : panel.series) {
    if (series.x.size() == 2 && series.width < 0.7) leads.push_back(series);
  }
  ASSERT_GE(leads.size(), 4U);
  const auto side = [](const svg::Series& line, double x, double y) {
    return (line.x[1] - line.x[0]) * (y - line.y[0]) - (line.y[1] - line.y[0]) * (x - line.x[0]);
  };
  const auto parts = [&](const svg::Series& a, const svg::Series& b) {
    return side(a, b.x[0], b.y[0]) * side(a, b.x[1], b.y[1]) < 0.0;
  };
  for (std::size_t i = 0; i < leads.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_FALSE(parts(leads[i], leads[k]) && parts(leads[k], leads[i])) << i << " and " << k;
    }
  }
}

TEST(MarginsPicture, GivesAnUnstableLoopNoGrade) {
  const LoopAtSpeed loop = Loop(0.3);  // weaker than the magnets' negative stiffness
  ASSERT_FALSE(loop.peaks.stable);
  EXPECT_THAT(SensitivityPanel(loop, kChannels).title, testing::HasSubstr("UNSTABLE: no grade"));
}

TEST(MarginsPicture, ShowsNamesOfOthersAsText) {
  const std::string drawn =
      svg::Draw(MarginsPicture("rig <script>", {Loop()}, {"a<b", "c&d", "e\"f", "g"}));
  EXPECT_THAT(drawn, testing::HasSubstr("rig &lt;script&gt;"));
  EXPECT_THAT(drawn, testing::HasSubstr("a&lt;b"));
  EXPECT_THAT(drawn, testing::Not(testing::HasSubstr("<script")));
  EXPECT_THAT(drawn, testing::Not(testing::HasSubstr("nan")));
}

}  // namespace
}  // namespace levitas::report
