#include "transport/stop_receiver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>

#include "tests/unit/transport/operator_receiver_fixture.hpp"

namespace levitas::transport {
namespace {

using namespace test;
// The harm and the protection in one: the commands' thread hangs, as it did behind a slow request,
// and nothing of what it takes gets through; the stop does.
TEST_F(Receiver, HearsAnEmergencyStopWhileTheCommandsThreadIsHeldUp) {
  HoldUp(true);
  for (std::int64_t number = 1; number <= 1000; ++number) Send(0, number, kLand);
  Send(0, 1001, kStop);
  EXPECT_TRUE(Eventually([this] { return stops_.asked() == 1; }));
  {
    const std::lock_guard lock(mutex_);
    EXPECT_TRUE(taken_.empty());
  }
}

TEST_F(Receiver, TakesEverySoundStopWhateverItsNumber) {
  Send(0, 9, kLand);
  ASSERT_TRUE(Eventually([this] {
    const std::lock_guard lock(mutex_);
    return taken_.size() == 1;
  }));
  Send(0, 9, kStop);
  Send(0, 9, kStop);
  Send(0, 1, kStop);  // older than what this sender has said
  EXPECT_TRUE(Eventually([this] { return stops_.asked() == 3; }));
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{kLand});  // it is nobody else's
}

TEST_F(Receiver, HearsAStopWhateverItsUnusedFieldsHold) {
  for (const double unused : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e308}) Send(0, 1, kStop, unused);
  EXPECT_TRUE(Eventually([this] { return stops_.asked() == 4; }));
}

TEST_F(Receiver, HearsNoStopInWhatIsNone) {
  Send(0, 1, kStop, 0.0, channel::kState);
  Send(0, 2, static_cast<OperatorCommand>(static_cast<int>(kStop) | 0x80));
  Send(0, 3, kLand);
  SendText(4, "emergency_stop");
  SendCut(kStop);
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{kLand});
  EXPECT_EQ(stops_.asked(), 0U);
}

// Reset and lift wait in the socket behind a slow thread; the stop that was sent after them is
// taken before. They must not lift the rotor again when the thread comes to them.
TEST_F(Receiver, DropsWhatWasSentBeforeAStopAndReadAfterIt) {
  HoldUp(true);
  Send(0, 1, kLand);
  ASSERT_TRUE(Eventually([this] {  // the thread is held up in it
    const std::lock_guard lock(mutex_);
    return entered_ == 1;
  }));
  Send(0, 2, kReset);
  Send(0, 3, kLift);
  Send(1, 1, kStop);
  ASSERT_TRUE(Eventually([this] { return stops_.asked() == 1; }));
  HoldUp(false);
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{kLand});
  EXPECT_EQ(receiver_->counts().overtaken, 2U);
  Send(0, 2, kReset);  // their numbers are free: said again they are taken, and know the stop
  ASSERT_TRUE(Eventually([this] {
    const std::lock_guard lock(mutex_);
    return taken_.back().command == kReset;
  }));
  EXPECT_EQ(taken_.back().stops_before, 1U);
}

TEST_F(Receiver, WithoutAStopTakesAllThatWaited) {
  HoldUp(true);
  Send(0, 1, kLand);
  Send(0, 2, kReset);
  Send(0, 3, kLift);
  HoldUp(false);
  EXPECT_EQ(TakenBeforeTheEnd(), (Commands{kLand, kReset, kLift}));
}

}  // namespace
}  // namespace levitas::transport
