#include "report/svg/figure.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "common/problem.hpp"

namespace levitas::svg {
namespace {

using testing::HasSubstr;
using testing::Not;

Figure OneLine(std::vector<double> x, std::vector<double> y) {
  Series series{.name = "model", .x = std::move(x), .y = std::move(y)};
  Panel panel{.title = "de_x", .x_label = "Hz", .y_label = "um/A", .series = {series}};
  return {.title = "Bode", .panels = {panel}};
}

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Figure, NamesTitlesAxesAndSeries) {
  const std::string svg = Draw(OneLine({0, 1}, {0, 1}));
  for (const char* text : {"Bode", "de_x", "Hz", "um/A", "model"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_EQ(svg.rfind("<svg", 0), 0U);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
}

TEST(Figure, EscapesWhatWouldEndATag) {
  Figure figure = OneLine({0, 1}, {0, 1});
  figure.panels[0].title = "a < b & c";
  EXPECT_THAT(Draw(figure), HasSubstr("a &lt; b &amp; c"));
}

TEST(Figure, InterruptsALineWhereAValueIsMissing) {
  const std::string whole = Draw(OneLine({0, 1, 2, 3}, {0, 1, 2, 3}));
  const std::string broken = Draw(OneLine({0, 1, 2, 3}, {0, std::nan(""), 2, 3}));
  // The path of the series starts with M once per piece.
  const auto pieces = [](const std::string& svg) {
    const auto from = svg.find("<path d='M", svg.find("clip-path"));
    return Count(svg.substr(from, svg.find("fill='none'", from) - from), "M");
  };
  EXPECT_EQ(pieces(whole), 1U);
  EXPECT_EQ(pieces(broken), 2U);
  EXPECT_THAT(broken, Not(HasSubstr("nan")));
}

TEST(Figure, DrawsOneMarkPerPoint) {
  Figure figure = OneLine({0, 1, 2}, {0, 1, 2});
  figure.panels[0].series[0].mark = Mark::kDot;
  EXPECT_EQ(Count(Draw(figure), "<circle"), 3U);
}

TEST(Figure, PutsPanelsIntoAGrid) {
  Figure figure = OneLine({0, 1}, {0, 1});
  figure.title.clear();
  figure.columns = 2;
  figure.panels.resize(3, figure.panels[0]);
  // Two columns of 420, two rows of 260.
  EXPECT_THAT(Draw(figure), HasSubstr("viewBox='0 0 840 520'"));
}

/// Width over height of the line of a circle, in pixels.
double Roundness(const std::string& svg) {
  const auto from = svg.find("<path d='M", svg.find("clip-path")) + 9;
  std::istringstream path(svg.substr(from, svg.find('\'', from) - from));
  double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
  char letter = 0;
  for (double x = 0, y = 0; path >> letter >> x >> y;) {
    low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  return (high_x - low_x) / (high_y - low_y);
}

TEST(Figure, DrawsACircleRoundOnlyWhenBothAxesHaveTheSameScale) {
  std::vector<double> x, y;
  for (int i = 0; i <= 360; ++i) {
    x.push_back(5.0 + std::cos(i * M_PI / 180.0));
    y.push_back(std::sin(i * M_PI / 180.0));
  }
  Figure figure = OneLine(x, y);
  EXPECT_GT(Roundness(Draw(figure)), 1.5);  // panels are wider than high
  figure.panels[0].same_scale = true;
  EXPECT_NEAR(Roundness(Draw(figure)), 1.0, 0.01);  // coordinates have a tenth of a pixel
}

TEST(Figure, TellsForwardFromBackwardMarksByTheirShape) {
  Figure figure = OneLine({0}, {0});
  std::string drawn[2];
  figure.panels[0].series[0].mark = Mark::kUp;
  drawn[0] = Draw(figure);
  figure.panels[0].series[0].mark = Mark::kDown;
  drawn[1] = Draw(figure);
  EXPECT_THAT(drawn[0], Not(HasSubstr("fill='white' stroke=")));
  EXPECT_THAT(drawn[1], HasSubstr("fill='white' stroke="));
}

TEST(Figure, BreaksALegendThatIsTooLongAndMakesRoomForIt) {
  Figure figure = OneLine({0, 1}, {0, 1});
  figure.panels[0].series.resize(8, figure.panels[0].series[0]);
  for (auto& series : figure.panels[0].series) series.name = "a name of some length";
  const double below = Places(figure)[0].top;
  figure.panels[0].series.resize(1);
  EXPECT_GT(below, Places(figure)[0].top + 30.0);  // three rows more
}

TEST(Figure, LeavesOutNotesBeyondThePanelAndEscapesTheOthers) {
  Figure figure = OneLine({0, 1}, {0, 1});
  figure.panels[0].notes = {{.x = 0.5, .y = 0.5, .text = "in<side"},
                            {.x = 9.0, .y = 0.5, .text = "out"}};
  EXPECT_THAT(Draw(figure), HasSubstr("in&lt;side"));
  EXPECT_THAT(Draw(figure), Not(HasSubstr(">out<")));
}

TEST(Places, AreWhereTheAxesOfEachPanelStandInTheDrawing) {
  Figure figure = OneLine({0, 1}, {0, 1});
  figure.columns = 2;
  figure.lines = {"one"};
  figure.panels.resize(3, figure.panels[0]);
  const auto places = Places(figure);
  ASSERT_EQ(places.size(), 3U);
  EXPECT_DOUBLE_EQ(places[1].left - places[0].left, figure.panel_width);
  EXPECT_DOUBLE_EQ(places[2].top - places[0].top, figure.panel_height);
  EXPECT_LE(places[0].x.low, 0.0);
  EXPECT_GE(places[0].x.high, 1.0);
  // The frame of the panel is drawn there.
  EXPECT_THAT(Draw(figure),
              HasSubstr("<rect x='62.0' y='" + std::to_string(places[0].top).substr(0, 4)));
}

TEST(Figure, RefusesASeriesOfUnequalLengths) {
  EXPECT_THROW((void)Draw(OneLine({0, 1, 2}, {0, 1})), std::invalid_argument);
}

TEST(Figure, SaysWhichFileCannotBeWritten) {
  try {
    Write("/no/such/folder/a.svg", OneLine({0, 1}, {0, 1}));
    FAIL() << "written";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("/no/such/folder/a.svg"));
  }
}

}  // namespace
}  // namespace levitas::svg
