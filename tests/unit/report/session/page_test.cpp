#include "report/session/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/report/session/whirling_rotor.hpp"

namespace levitas::report {
namespace {

using test::WhirlingRotor;
using testing::HasSubstr;
using testing::Not;

std::string PageOf(const Recording& recording) {
  PageInput input;
  input.session_path = "run.lcm";
  input.pictures = Pictures(recording, {});
  return Page(recording, input);
}

std::size_t Count(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(ReportPage, NeedsNothingBesideIt) {
  const std::string page = PageOf(WhirlingRotor());
  EXPECT_EQ(Count(page, "<script"), 1U);
  EXPECT_EQ(Count(page, "<script>"), 1U);  // the page's own, from nowhere else
  for (const char* outside : {"http:", "https:", "fetch(", "import", "XMLHttpRequest"}) {
    const std::string script = page.substr(page.find("<script>"));
    EXPECT_EQ(Count(script, outside), 0U) << outside;
  }
  EXPECT_EQ(Count(page, "<link"), 0U);
  EXPECT_EQ(Count(page, "src="), Count(page, "src=\"data:image/svg+xml,"));
  EXPECT_EQ(Count(page, "url("), Count(page, "url(%23"));  // within the pictures themselves
}

TEST(ReportPage, GivesEveryPictureWordsInItsPlace) {
  const std::string page = PageOf(WhirlingRotor());
  EXPECT_EQ(Count(page, "<img "), Count(page, "<img alt=\""));
  EXPECT_EQ(Count(page, "alt=\"\""), 0U);
}

TEST(ReportPage, ShowsTextOfTheSessionAsTextWhateverItHolds) {
  Recording r = WhirlingRotor();
  r.header.rig_yaml = "name: <b>\"&\n";
  r.header.machine = "<script>alert(1)</script>";
  session::Event trip;
  trip.severity = session::Event::Severity::kTrip;
  trip.cycle = 20'000;
  trip.text = "TRIP <img src=x>";
  r.events = {trip};
  const std::string page = PageOf(r);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<img src=x>")));
  EXPECT_THAT(page, HasSubstr("name: &lt;b&gt;&quot;&amp;"));
  EXPECT_THAT(page, HasSubstr("<tr class=\"trip\"><td class=n>2.000</td><td>TRIP &lt;img"));
}

// Before any picture, so that it is what is seen first.
TEST(ReportPage, OpensWithTheVerdict) {
  const std::string page = PageOf(WhirlingRotor());
  EXPECT_LT(page.find("class=verdict"), page.find("<figure"));
  EXPECT_LT(page.find("class=verdict"), page.find("<nav>"));
}

TEST(ReportPage, LinksOnlyToPlacesThatItHas) {
  PageInput input;
  input.pictures = Pictures(WhirlingRotor(), {});
  input.levitated.emplace().speeds.push_back({1.0, {}});
  for (const bool levitated : {true, false}) {
    if (!levitated) input.levitated.reset();
    const std::string page = Page(WhirlingRotor(), input);
    for (auto at = page.find("href=\"#"); at != std::string::npos; at = page.find("href=\"#", at)) {
      at += 7;
      const std::string place = page.substr(at, page.find('"', at) - at);
      EXPECT_THAT(page, HasSubstr("id=" + place + ">")) << place;
    }
  }
}

TEST(ReportPage, SaysWhatIsNotJudged) {
  EXPECT_THAT(PageOf(WhirlingRotor()), HasSubstr("Not judged"));
}

TEST(ReportPage, ShowsTheVerdictsSentenceAndTheDurations) {
  const Recording r = WhirlingRotor();
  PageInput input;
  input.verdict.emplace();
  input.verdict->inputs.rig = r.rig;
  input.verdict->outcome = verdict::Outcome::kAccepted;
  input.verdict->sentence = "ACCEPTED: within 1 & 2";
  verdict::DurationFigures compute;
  compute.name = "compute";
  compute.count = 7;
  compute.p50_ns = 8'250.0;
  input.durations.push_back(compute);
  const std::string page = Page(r, input);
  EXPECT_THAT(page, HasSubstr("<p class=\"verdict good\">ACCEPTED: within 1 &amp; 2</p>"));
  EXPECT_THAT(page, HasSubstr("<td>compute</td><td class=n>7</td><td class=n>8.25</td>"));
}

}  // namespace
}  // namespace levitas::report
