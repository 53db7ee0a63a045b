#include "report/html/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "report/html/elements.hpp"
#include "report/html/escaped_text.hpp"

namespace levitas::html {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kMark = "<img src=x>";
constexpr const char* kShown = "&lt;img src=x&gt;";

TEST(Escaped, LeavesNothingThatEndsATagOrAnAttributeAndDoesNotEscapeTwice) {
  EXPECT_EQ(Escaped("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;'");
  EXPECT_EQ(Escaped("&amp;"), "&amp;amp;");  // the text was "&amp;", and is shown so
  EXPECT_EQ(Escaped(""), "");
}

TEST(Table, ShowsEveryCellAndTitleAsTextWhateverItHolds) {
  Table table({{kMark}, {"n", Kind::kNumber}, {"k", Kind::kKey}});
  table.Add({kMark, kMark, kMark});
  EXPECT_THAT(table.Html(), Not(HasSubstr(kMark)));
  EXPECT_THAT(table.Html(), HasSubstr("<td>" + std::string(kShown) + "</td><td class=n>" + kShown +
                                      "</td><td class=k>" + kShown + "</td>"));
}

TEST(Table, TakesMarkupOnlyWhereTheColumnSaysSo) {
  Table table(std::vector<Column>{{"", Kind::kMarkup}, {}});
  table.Add({"<b>1</b>", "<b>1</b>"});
  EXPECT_THAT(table.Html(), HasSubstr("<td><b>1</b></td><td>&lt;b&gt;1&lt;/b&gt;</td>"));
}

TEST(Table, HasAHeadOnlyWhereAColumnHasATitle) {
  Table named({{"rpm", Kind::kNumber}, {}});
  EXPECT_THAT(named.Html(), HasSubstr("<tr><th class=n>rpm</th><th></th></tr>"));
  EXPECT_THAT(Table(std::vector<Column>(2)).Html(), Not(HasSubstr("<tr>")));
}

TEST(Table, MarksARowWithItsClassAndIsFoundByItsName) {
  Table table(std::vector<Column>(1), "orbits");
  EXPECT_TRUE(table.empty());
  table.Add({"a"}, "trip");
  table.Add({"b"});
  EXPECT_FALSE(table.empty());
  EXPECT_EQ(table.Scrolling(),
            "<div class=scroll><table id=\"orbits\">\n<tr class=\"trip\"><td>a</td></tr>\n"
            "<tr><td>b</td></tr>\n</table>\n</div>\n");
}

// A cell too few would shift what stands behind it under another title.
TEST(Table, RefusesARowOfAnotherLength) {
  Table table(std::vector<Column>{{"a"}, {"b"}});
  EXPECT_THROW(table.Add({"one"}), std::invalid_argument);
  EXPECT_THROW(table.Add({"one", "two", "three"}), std::invalid_argument);
  EXPECT_TRUE(table.empty());
}

TEST(Elements, ShowTheirTextAsTextAndNothingWithoutOne) {
  for (const std::string& html : {Paragraph(kMark), Paragraphs({"a", kMark}, "c"),
                                  List({kMark}, "c"), Folded(kMark, kMark)}) {
    EXPECT_THAT(html, Not(HasSubstr(kMark)));
    EXPECT_THAT(html, HasSubstr(kShown));
  }
  EXPECT_EQ(Paragraph(""), "");
  EXPECT_EQ(Paragraphs({}), "");
  EXPECT_EQ(List({}, "c"), "");
  EXPECT_EQ(Folded("title", ""), "");
  EXPECT_EQ(Paragraph("a", "verdict good"), "<p class=\"verdict good\">a</p>\n");
}

}  // namespace
}  // namespace levitas::html
