#include "dashboard/hub.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace levitas::dashboard {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::Not;

constexpr milliseconds kAtOnce{0};
constexpr milliseconds kHubLimit{
    20'000};  // far above any delay: a test that waits this long has failed

TEST(Hub, GivesAViewerTheNewestOfEachTopicOnce) {
  Hub hub;
  hub.Put(Topic::kTick, R"({"cycle":1})");
  hub.Put(Topic::kTick, R"({"cycle":2})");
  Seen seen;
  const std::string first = hub.Wait(seen, kAtOnce);
  EXPECT_EQ(first, "event: tick\ndata: {\"cycle\":2}\n\n");
  EXPECT_EQ(hub.Wait(seen, kAtOnce), "");
}

TEST(Hub, LetsASlowViewerMissTicksAndKeepsNoneForIt) {
  Hub hub;
  Seen slow;
  for (int i = 0; i < 100'000; ++i) hub.Put(Topic::kTick, std::to_string(i));
  EXPECT_EQ(hub.Wait(slow, kAtOnce), "event: tick\ndata: 99999\n\n");
}

TEST(Hub, TellsNobodyWhatItForgotAndEverybodyWhatCameLater) {
  Hub hub;
  Seen early;
  Seen late;
  hub.Put(Topic::kTick, "old");
  hub.Put(Topic::kTiming, "kept");
  EXPECT_THAT(hub.Wait(early, kAtOnce), HasSubstr("old"));
  hub.Forget(Topic::kTick);
  EXPECT_EQ(hub.Wait(early, kAtOnce), "");
  EXPECT_EQ(hub.Wait(late, kAtOnce), "event: timing\ndata: kept\n\n");
  hub.Put(Topic::kTick, "new");
  EXPECT_EQ(hub.Wait(early, kAtOnce), "event: tick\ndata: new\n\n");
  EXPECT_EQ(hub.Wait(late, kAtOnce), "event: tick\ndata: new\n\n");
}

TEST(Hub, TellsEveryViewerEveryEventInOrder) {
  Hub hub;
  Seen early;
  hub.PutEvent(1, "one");
  EXPECT_THAT(hub.Wait(early, kAtOnce), HasSubstr("one"));
  hub.PutEvent(2, "two");
  hub.PutEvent(3, "three");
  EXPECT_EQ(hub.Wait(early, kAtOnce), "event: log\ndata: two\n\nevent: log\ndata: three\n\n");
  Seen late;
  EXPECT_THAT(hub.Wait(late, kAtOnce), HasSubstr("one"));
}

TEST(Hub, KeepsABoundedNumberOfEvents) {
  Hub hub;
  for (std::uint64_t i = 1; i <= 10 * Hub::kEvents; ++i)
    hub.PutEvent(i, "e" + std::to_string(i) + "e");
  Seen seen;
  const std::string told = hub.Wait(seen, kAtOnce);
  EXPECT_THAT(told, HasSubstr("e2000e"));
  EXPECT_THAT(told, Not(HasSubstr("e1800e")));
  EXPECT_THAT(told, HasSubstr("e1801e"));
}

TEST(Hub, WakesAWaitingViewer) {
  Hub hub;
  Seen seen;
  std::string told;
  std::thread viewer([&] { told = hub.Wait(seen, kHubLimit); });
  hub.Put(Topic::kSpectrum, "{}");
  viewer.join();
  EXPECT_EQ(told, "event: spectrum\ndata: {}\n\n");
}

TEST(Hub, LetsEveryViewerGoWhenItCloses) {
  Hub hub;
  Seen seen;
  std::thread viewer([&] { EXPECT_EQ(hub.Wait(seen, kHubLimit), ""); });
  hub.Close();
  viewer.join();
  EXPECT_TRUE(hub.closed());
}

}  // namespace
}  // namespace levitas::dashboard
