// When a run brings its page, and when it sends a browser there.

#include "cli/run/live_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <unistd.h>

#include <string>
#include <utility>
#include <vector>

namespace levitas::cli {
namespace {

using testing::HasSubstr;

constexpr PageSurroundings kBench{
    .terminal = true, .desktop = true, .automation = false, .clocked = true};

TEST(PlanPage, OpensABrowserWhereSomebodyWatchesARunAtTheClocksPace) {
  const PagePlan plan = PlanPage(PageWish::kIfUseful, kBench);
  EXPECT_TRUE(plan.serve);
  EXPECT_TRUE(plan.open);
}

TEST(PlanPage, OnlyNamesTheAddressWithoutADesktop) {
  PageSurroundings shell = kBench;
  shell.desktop = false;
  const PagePlan plan = PlanPage(PageWish::kIfUseful, shell);
  EXPECT_TRUE(plan.serve);
  EXPECT_FALSE(plan.open);
}

TEST(PlanPage, BringsNothingUnaskedWhereNobodyLooksOrTheRunIsOverAtOnce) {
  PageSurroundings script = kBench;
  script.terminal = false;
  EXPECT_FALSE(PlanPage(PageWish::kIfUseful, script).serve);
  PageSurroundings automation = kBench;
  automation.automation = true;
  EXPECT_FALSE(PlanPage(PageWish::kIfUseful, automation).serve);
  PageSurroundings lockstep = kBench;
  lockstep.clocked = false;
  EXPECT_FALSE(PlanPage(PageWish::kIfUseful, lockstep).serve);
}

TEST(PlanPage, ServesWhenAskedToButNeverSendsAScriptsBrowserThere) {
  PageSurroundings script = kBench;
  script.terminal = false;
  EXPECT_TRUE(PlanPage(PageWish::kAlways, script).serve);
  EXPECT_FALSE(PlanPage(PageWish::kAlways, script).open);
  PageSurroundings automation = kBench;
  automation.automation = true;
  EXPECT_FALSE(PlanPage(PageWish::kAlways, automation).open);
}

TEST(PlanPage, RespectsARefusal) { EXPECT_FALSE(PlanPage(PageWish::kNever, kBench).serve); }

transport::LcmNetwork OwnNetwork() {
  transport::LcmNetwork network;
  network.group = "239.255.76.70";
  network.base_port = static_cast<std::uint16_t>(20'000 + 4 * (getpid() % 10'000));
  return network;
}

TEST(LivePage, SaysWhereItIsOrWhyItIsNot) {
  std::vector<std::string> said;
  const LivePage page({true, false}, OwnNetwork(), [&](const auto& line) { said.push_back(line); });
  ASSERT_EQ(said.size(), 1U);
  EXPECT_THAT(said.front(), HasSubstr("live page: "));  // where no network is: "no live page: ..."
}

TEST(LivePage, IsSilentWhenItIsNotServed) {
  std::vector<std::string> said;
  const LivePage page({}, OwnNetwork(), [&](const auto& line) { said.push_back(line); });
  EXPECT_TRUE(said.empty());
}

/// What viewers of a page are told of the end of its run; waits until it comes.
std::string EndTold(const std::string& url) {
  const std::string host = url.substr(0, url.find('/', std::string("http://").size()));
  httplib::Client client(host);
  std::string told, text;
  static_cast<void>(client.Get("/events", [&](const char* part, std::size_t size) {
    text.append(part, size);
    const std::size_t end = text.find("event: end\n");
    if (end == std::string::npos || text.find("\n\n", end) == std::string::npos) return true;
    told = text.substr(end, text.find("\n\n", end) - end);
    return false;
  }));
  return told;
}

TEST(LivePage, TellsItsViewersThatTheRunIsOverBeforeItIsJudged) {
  std::vector<std::string> said;
  LivePage page({true, false}, OwnNetwork(), [&](const auto& line) { said.push_back(line); });
  ASSERT_EQ(said.size(), 1U);
  const std::string announced = "live page: ";
  if (said.front().rfind(announced, 0) != 0) GTEST_SKIP() << said.front();
  for (const auto& [status, sentence] :
       {std::pair{ExitStatus::kDone, "The run has ended. It is being judged."},
        std::pair{ExitStatus::kTripped, "The run has ended with a trip. It is being judged."}}) {
    const ExitStatus came =
        page.Outlive([&, status = status, sentence = sentence](LivePage::Ending& ending) {
          ending.over(status);
          EXPECT_THAT(EndTold(said.front().substr(announced.size())), HasSubstr(sentence));
          ending.interrupted = true;  // nothing more is to be seen: the page need not stay
          return status;
        });
    EXPECT_EQ(came, status);
  }
}

}  // namespace
}  // namespace levitas::cli
