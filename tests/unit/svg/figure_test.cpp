#include "report/svg/figure.hpp"

#include <gmock/gmock.h>

#include <cmath>
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
