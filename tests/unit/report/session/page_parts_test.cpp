#include "report/session/page_parts.hpp"

#include <gtest/gtest.h>

namespace levitas::report {
namespace {

NamedPicture Picture(const char* name, const char* caption) {
  NamedPicture picture;
  picture.name = name;
  picture.caption = caption;
  picture.figure.panels.resize(1);
  picture.figure.panels[0].title = "100 % of #1 & \"2\"";
  return picture;
}

TEST(PageStart, ShowsATitleOfOthersAsText) {
  const std::string html = PageStart("a<b & c");
  EXPECT_NE(html.find("<title>a&lt;b &amp; c</title>"), std::string::npos) << html;
  EXPECT_NE(html.find("<h1>a&lt;b &amp; c</h1>"), std::string::npos) << html;
  EXPECT_EQ(html.find("a<b"), std::string::npos);
}

TEST(PageStart, BeginsADocumentThatPageEndCloses) {
  EXPECT_TRUE(PageStart("t").starts_with("<!doctype html>"));
  EXPECT_TRUE(PageEnd().ends_with("</body></html>\n"));
}

TEST(Gallery, HoldsEachPictureWithItsNameAndCaptionInTheirOrder) {
  const std::string html = Gallery({Picture("orbit", "the orbit"), Picture("time", "over time")});
  const std::size_t first = html.find("id=\"orbit\"");
  const std::size_t second = html.find("id=\"time\"");
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(second, std::string::npos);
  EXPECT_LT(first, second);
  EXPECT_NE(html.find("<figcaption>the orbit</figcaption>"), std::string::npos);
}

// Within an attribute: a mark of the picture that ends it would break the page.
TEST(Gallery, KeepsThePictureWithinItsAddress) {
  const std::string html = Gallery({Picture("a", "b")});
  const std::string begin = "src=\"data:image/svg+xml,";
  const std::size_t at = html.find(begin);
  ASSERT_NE(at, std::string::npos);
  const std::size_t from = at + begin.size();
  const std::string address = html.substr(from, html.find('"', from) - from);
  for (const char mark : {'<', '>', '#', '&', '\n'}) {
    EXPECT_EQ(address.find(mark), std::string::npos) << mark;
  }
  EXPECT_TRUE(address.starts_with("%3Csvg")) << address.substr(0, 20);
  EXPECT_TRUE(address.ends_with("%3C/svg%3E") || address.ends_with("%3C/svg%3E%0A"));
}

// A cursor reads values from them: they must be those of the drawing.
TEST(Gallery, TellsTheScriptWhereTheAxesStand) {
  NamedPicture picture = Picture("a", "b");
  svg::Panel& panel = picture.figure.panels[0];
  panel.x_label = "it's \"x\"";
  panel.x_range = svg::Range{1.0, 1000.0};
  panel.x_scale = svg::Scale::kLogarithmic;
  panel.y_range = svg::Range{-2.0, 2.0};
  const std::string html = Gallery({picture});
  EXPECT_NE(html.find("data-view=\"0 0 420 260\""), std::string::npos) << html.substr(0, 400);
  EXPECT_NE(html.find("&quot;x&quot;:[1,1000,true],&quot;y&quot;:[-2,2,false]"), std::string::npos);
  EXPECT_NE(html.find("&quot;it's \\&quot;x\\&quot;:&quot;"), std::string::npos);
}

TEST(Gallery, ShowsACaptionOfOthersAsText) {
  EXPECT_EQ(Gallery({Picture("a", "<script>")}).find("<script>"), std::string::npos);
}

}  // namespace
}  // namespace levitas::report
