// The controller's end of the bus: each fault of the bus has one defined result.

#include "hil/can_port/can_rig_port.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hil/can_port/can_rig_link.hpp"
#include "rt/clock.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/unit/can_port/fake_bus.hpp"

namespace levitas::can_port {
namespace {

using can::BusEvent;
using port::ReadResult;
using testing::HasSubstr;

class CanRigPortTest : public testing::Test {
 protected:
  CanRigPortTest() {
    rig_bus_.other = &controller_bus_;
    controller_bus_.other = &rig_bus_;
  }

  SensorFrame Frame(std::uint64_t cycle) {
    SensorFrame frame;
    frame.cycle = cycle;
    frame.rig_session = 1;
    frame.axes = 4;
    frame.position_m = {1e-6, -2e-6, 3e-6, -4e-6};
    return frame;
  }
  /// One period: the rig sends, the controller reads.
  ReadResult Period(std::uint64_t cycle) {
    link_.Send(Frame(cycle));
    return port_.Read(frame_, 0);
  }

  can::Layout layout_ = can::MakeLayout(can::TestRig(4), can::Format::kFd);
  FakeBus rig_bus_;
  FakeBus controller_bus_;
  CanRigLink link_{layout_, TwoBuses(), rig_bus_};
  CanRigPort port_{layout_, TwoBuses(), {}, controller_bus_};
  SensorFrame frame_;
};

TEST_F(CanRigPortTest, DeliversWhatTheRigSent) {
  ASSERT_EQ(Period(0), ReadResult::kFrame);
  ASSERT_EQ(Period(1), ReadResult::kFrame);
  EXPECT_EQ(frame_.cycle, 1U);
  EXPECT_EQ(frame_.axes, 4U);
  EXPECT_EQ(frame_.rig_session, 1U);
  EXPECT_NEAR(frame_.position_m[3], -4e-6, 5e-9);
  EXPECT_EQ(frame_.sample_time_ns, 100'000);  // lockstep: cycle x period
  EXPECT_EQ(port_.counters().frames_read, 2U);
  EXPECT_EQ(port_.Trouble(), "");
}

TEST_F(CanRigPortTest, CurrentsArriveAtTheRigWithTheirBiasInTheSamePeriod) {
  ASSERT_EQ(Period(0), ReadResult::kFrame);
  CurrentFrame current{.cycle = 0, .axes = 4, .control_current_a = {0.5, -0.5, 0.25, 0.0}};
  current.bias_current_a = 1.0;
  current.amplifiers_enabled = true;
  ASSERT_TRUE(port_.Write(current));
  CurrentFrame got;
  ASSERT_EQ(link_.Receive(got, 0), port::RigLink::ReceiveResult::kCurrent);
  EXPECT_NEAR(got.control_current_a[1], -0.5, 5e-5);
  EXPECT_NEAR(got.bias_current_a, 1.0, 5e-4);
  EXPECT_TRUE(got.amplifiers_enabled);
}

TEST_F(CanRigPortTest, SendsEachDirectionOverItsOwnBus) {
  Period(0);
  port_.Write({.cycle = 0, .axes = 4});
  EXPECT_THAT(rig_bus_.sent_bus, testing::Each(0U));
  EXPECT_THAT(controller_bus_.sent_bus, testing::Each(1U));
}

TEST_F(CanRigPortTest, ReadsNothingFromASilentBus) {
  EXPECT_EQ(port_.Read(frame_, 0), ReadResult::kNothing);
  EXPECT_EQ(controller_bus_.waits, 1);
}

TEST_F(CanRigPortTest, ReturnsTheNewestAndCountsTheOvertaken) {
  for (std::uint64_t cycle = 0; cycle < 5; ++cycle) link_.Send(Frame(cycle));
  ASSERT_EQ(port_.Read(frame_, 0), ReadResult::kFrame);
  EXPECT_EQ(frame_.cycle, 4U);
  EXPECT_EQ(port_.counters().frames_skipped, 4U);
}

TEST_F(CanRigPortTest, TakesADamagedFrameForAMissingOne) {
  Period(0);
  link_.Send(Frame(1));
  controller_bus_.arrived.back().frame.data[6] ^= 4U;
  EXPECT_EQ(port_.Read(frame_, 0), ReadResult::kNothing);
  EXPECT_EQ(frame_.cycle, 0U);
  EXPECT_EQ(port_.counters().frames_rejected, 1U);
  EXPECT_EQ(Period(2), ReadResult::kFrame);
  EXPECT_EQ(port_.counters().frames_lost, 1U);
}

TEST_F(CanRigPortTest, TakesACopyOrAnOlderFrameForNone) {
  Period(0);
  link_.Send(Frame(1));
  const can::Reception first = controller_bus_.arrived.back();
  ASSERT_EQ(port_.Read(frame_, 0), ReadResult::kFrame);
  controller_bus_.arrived.push_back(first);
  EXPECT_EQ(port_.Read(frame_, 0), ReadResult::kNothing);
  ASSERT_EQ(Period(2), ReadResult::kFrame);
  controller_bus_.arrived.push_back(first);  // replayed
  EXPECT_EQ(port_.Read(frame_, 0), ReadResult::kNothing);
  EXPECT_THAT(port_.Trouble(), HasSubstr("1 x copy of a frame"));
  EXPECT_THAT(port_.Trouble(), HasSubstr("1 x frame out of order"));
}

TEST_F(CanRigPortTest, BelievesAndSendsNothingWhileTheBusIsOff) {
  Period(0);
  controller_bus_.Event(BusEvent::kBusOff);
  EXPECT_EQ(Period(1), ReadResult::kNothing);
  const std::size_t sent = controller_bus_.sent.size();
  EXPECT_FALSE(port_.Write({.cycle = 1, .axes = 4}));
  EXPECT_EQ(controller_bus_.sent.size(), sent);
  controller_bus_.Event(BusEvent::kRestarted);
  EXPECT_EQ(Period(2), ReadResult::kFrame);
  EXPECT_TRUE(port_.Write({.cycle = 2, .axes = 4}));
  EXPECT_THAT(port_.Trouble(), HasSubstr("1 x bus off; 1 x bus restarted"));
}

TEST_F(CanRigPortTest, CountsErrorPassiveAndWireErrorsWithoutStopping) {
  controller_bus_.Event(BusEvent::kErrorPassive);
  controller_bus_.Event(BusEvent::kProtocolError);
  controller_bus_.Event(BusEvent::kChipOverrun);
  EXPECT_EQ(Period(0), ReadResult::kFrame);
  EXPECT_EQ(port_.bus_counters().error_passive, 1U);
  EXPECT_EQ(port_.bus_counters().protocol_errors, 1U);
  EXPECT_EQ(port_.bus_counters().chip_overruns, 1U);
}

TEST_F(CanRigPortTest, CountsWhatTheBusCannotTakeAndTriesItOnce) {
  controller_bus_.result = can::SendResult::kFull;
  EXPECT_FALSE(port_.Write({.cycle = 0, .axes = 4}));
  EXPECT_EQ(port_.counters().write_failures, 1U);
  EXPECT_EQ(port_.bus_counters().full, 2U);  // drive and currents, each once
}

TEST_F(CanRigPortTest, SendsADriveMessageThatTheBusRefusedAgainInTheNextPeriod) {
  controller_bus_.result = can::SendResult::kFull;
  port_.Write({.cycle = 0, .axes = 4, .bias_current_a = 1.0});
  controller_bus_.result = can::SendResult::kSent;
  port_.Write({.cycle = 1, .axes = 4, .bias_current_a = 1.0});
  EXPECT_EQ(controller_bus_.sent.front().id, can::kDriveId);
}

TEST_F(CanRigPortTest, ReadsNoMoreThanItsShareOfABabblingNode) {
  Period(0);
  const can::WireFrame noise{.id = can::kPositionsId, .length = 16, .fd = true};
  for (int frame = 0; frame < 10 * kMostPerRead; ++frame) {
    controller_bus_.arrived.push_back({BusEvent::kFrame, 0, noise});
  }
  EXPECT_EQ(port_.Read(frame_, 0), ReadResult::kNothing);
  EXPECT_EQ(controller_bus_.arrived.size(), 9U * kMostPerRead);
  EXPECT_EQ(port_.bus_counters().read_limit, 1U);
}

TEST_F(CanRigPortTest, BelievesNoFrameBehindWhichANewerOneMayWait) {
  Period(0);
  for (std::uint64_t cycle = 1; cycle <= kMostPerRead + 1; ++cycle) link_.Send(Frame(cycle));
  EXPECT_EQ(port_.Read(frame_, 0), ReadResult::kNothing);
  EXPECT_EQ(frame_.cycle, 0U);
  ASSERT_EQ(port_.Read(frame_, 0), ReadResult::kFrame);
  EXPECT_EQ(frame_.cycle, kMostPerRead + 1U);
}

TEST_F(CanRigPortTest, SaysTheLinkIsDownOnceAndReadsSilence) {
  controller_bus_.Event(BusEvent::kLinkDown);
  EXPECT_EQ(port_.Read(frame_, 0), ReadResult::kNothing);
  EXPECT_THAT(port_.Trouble(), HasSubstr("1 x link down"));
}

TEST_F(CanRigPortTest, ShowsARestartOfTheRigAsANewSession) {
  Period(500);
  SensorFrame restarted = Frame(0);
  restarted.rig_session = 2;
  link_.Send(restarted);
  ASSERT_EQ(port_.Read(frame_, 0), ReadResult::kFrame);
  EXPECT_EQ(frame_.rig_session, 2U);
}

TEST_F(CanRigPortTest, InRealTimeDatesAFrameByItsReceptionLessItsTimeOnTheWire) {
  CanRigPort port(layout_, TwoBuses(), {.realtime = true, .wire_ns = 72'600}, controller_bus_);
  link_.Send(Frame(0));
  const std::int64_t now_ns = rt::MonotonicNowNs();
  controller_bus_.arrived.back().frame.received_ns = now_ns;
  ASSERT_EQ(port.Read(frame_, 0), ReadResult::kFrame);
  EXPECT_EQ(frame_.sample_time_ns, now_ns - 72'600);
}

TEST_F(CanRigPortTest, InRealTimeAFrameThatWaitedTwoPeriodsIsNoNews) {
  CanRigPort port(layout_, TwoBuses(), {.realtime = true}, controller_bus_);
  link_.Send(Frame(0));
  controller_bus_.arrived.back().frame.received_ns = rt::MonotonicNowNs() - 250'000;
  EXPECT_EQ(port.Read(frame_, 0), ReadResult::kNothing);
  EXPECT_EQ(port.bus_counters().stale, 1U);
}

TEST_F(CanRigPortTest, SaysGoodbyeThreeTimes) {
  Period(0);
  port_.SayGoodbye({.cycle = 0, .axes = 4});
  EXPECT_EQ(controller_bus_.sent.size(), 6U);  // currents, and the drive's set point
  CurrentFrame got;
  EXPECT_EQ(link_.Receive(got, 0), port::RigLink::ReceiveResult::kGoodbye);
}

// The set point travels in a message of its own: an older one would turn the rotor on.
TEST_F(CanRigPortTest, AGoodbyeThatBrakesCarriesTheSetPointOfTheBrake) {
  Period(0);
  port_.SayGoodbye({.cycle = 0,
                    .axes = 4,
                    .speed_set_point_rad_per_s = 0.0,
                    .acceleration_limit_rad_per_s2 = 104.0,
                    .drive_enabled = true});
  CurrentFrame got{.speed_set_point_rad_per_s = 314.0, .amplifiers_enabled = true};
  ASSERT_EQ(link_.Receive(got, 0), port::RigLink::ReceiveResult::kGoodbye);
  EXPECT_FALSE(got.amplifiers_enabled);
  EXPECT_TRUE(got.drive_enabled);
  EXPECT_EQ(got.speed_set_point_rad_per_s, 0.0);
  EXPECT_NEAR(got.acceleration_limit_rad_per_s2, 104.0, 0.01);
}

TEST_F(CanRigPortTest, AllocatesNothingInTheLoop) {
  controller_bus_.other = nullptr;
  controller_bus_.sent.reserve(10'000);
  controller_bus_.sent_bus.reserve(10'000);
  for (std::uint64_t cycle = 0; cycle < 1000; ++cycle) {
    link_.Send(Frame(cycle));
    const test::AllocationGuard guard;
    ASSERT_EQ(port_.Read(frame_, 0), ReadResult::kFrame);
    ASSERT_TRUE(port_.Write({.cycle = cycle, .axes = 4}));
    ASSERT_EQ(guard.count(), 0U);
  }
}

}  // namespace
}  // namespace levitas::can_port
