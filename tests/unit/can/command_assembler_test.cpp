// The rig's end: which current frame may act, and when the slow message goes out.

#include <gtest/gtest.h>

#include <limits>

#include "hil/can/assemblers.hpp"
#include "tests/unit/can/rigs.hpp"

namespace levitas::can {
namespace {

class CommandAssemblerTest : public testing::Test {
 protected:
  CurrentFrame Wanted(std::uint64_t cycle) {
    CurrentFrame frame;
    frame.cycle = cycle;
    frame.axes = 4;
    frame.control_current_a = {0.1, -0.2, 0.3, -0.4};
    frame.bias_current_a = 1.0;
    frame.speed_set_point_rad_per_s = 314.2;
    frame.acceleration_limit_rad_per_s2 = 20.9;
    frame.amplifiers_enabled = true;
    frame.drive_enabled = true;
    return frame;
  }
  WireFrame Send(std::uint64_t cycle, bool goodbye = false) {
    return currents_.Encode(ValuesOf(Wanted(cycle), goodbye));
  }
  Outcome Take(const WireFrame& wire, std::uint64_t own) {
    return assembler_.Take(wire, own, frame_);
  }

  Layout layout_ = MakeLayout(TestRig(4), Format::kFd);
  MessageCodec currents_{MessageNamed(layout_, "ControllerCurrents"), Format::kFd};
  MessageCodec drive_{MessageNamed(layout_, "ControllerDrive"), Format::kFd};
  CommandAssembler assembler_{layout_};
  CurrentFrame frame_;
};

TEST_F(CommandAssemblerTest, JoinsCurrentsWithTheLastDriveMessage) {
  EXPECT_EQ(Take(drive_.Encode(ValuesOf(Wanted(0), false)), 0), Outcome::kPart);
  EXPECT_EQ(Take(Send(0), 0), Outcome::kFrame);
  EXPECT_NEAR(frame_.control_current_a[3], -0.4, 1e-12);
  EXPECT_NEAR(frame_.bias_current_a, 1.0, 1e-12);
  EXPECT_NEAR(frame_.speed_set_point_rad_per_s, 314.2, 1e-9);
  EXPECT_NEAR(frame_.acceleration_limit_rad_per_s2, 20.9, 1e-9);
  EXPECT_TRUE(frame_.amplifiers_enabled);
  EXPECT_TRUE(frame_.drive_enabled);
}

TEST_F(CommandAssemblerTest, KnowsNoBiasBeforeTheFirstDriveMessage) {
  EXPECT_EQ(Take(Send(0), 0), Outcome::kFrame);
  EXPECT_EQ(frame_.bias_current_a, 0.0);
}

TEST_F(CommandAssemblerTest, CompletesTheCycleFromItsOwnCount) {
  for (std::uint64_t cycle = 0; cycle < 20'000; ++cycle) {
    ASSERT_EQ(Take(Send(cycle), cycle), Outcome::kFrame);
    ASSERT_EQ(frame_.cycle, cycle);
  }
  EXPECT_EQ(Take(Send(20'000), 20'002), Outcome::kFrame);  // late, but newer than the last
  EXPECT_EQ(frame_.cycle, 20'000U);
  EXPECT_EQ(assembler_.lost(), 0U);
}

TEST_F(CommandAssemblerTest, RefusesCurrentsThatAreOlderThanTheLastOrOfTheFuture) {
  const WireFrame old = Send(100);
  EXPECT_EQ(Take(Send(105), 105), Outcome::kFrame);
  EXPECT_EQ(Take(old, 106), Outcome::kOutOfOrder);
  EXPECT_EQ(Take(Send(107), 106), Outcome::kOutOfOrder);
  EXPECT_EQ(Take(Send(4095), 106), Outcome::kOutOfOrder);  // would be from before the start
}

TEST_F(CommandAssemblerTest, IgnoresCopies) {
  const WireFrame wire = Send(7);
  EXPECT_EQ(Take(wire, 7), Outcome::kFrame);
  EXPECT_EQ(Take(wire, 7), Outcome::kRepeated);
  EXPECT_EQ(Take(Send(7), 7), Outcome::kFrame);  // answered again
}

TEST_F(CommandAssemblerTest, RefusesACurrentThatIsNoNumber) {
  CurrentFrame wanted = Wanted(3);
  wanted.control_current_a[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Take(currents_.Encode(ValuesOf(wanted, false)), 3), Outcome::kDamaged);
  EXPECT_EQ(Take(Send(4), 4), Outcome::kFrame);  // and recovers with the next
}

TEST_F(CommandAssemblerTest, PassesTheGoodbyeOn) {
  EXPECT_EQ(Take(Send(3, true), 3), Outcome::kGoodbye);
}

TEST_F(CommandAssemblerTest, CountsCyclesWithoutACurrent) {
  EXPECT_EQ(Take(Send(10), 10), Outcome::kFrame);
  EXPECT_EQ(Take(Send(14), 14), Outcome::kFrame);
  EXPECT_EQ(assembler_.lost(), 3U);
}

TEST(DriveSchedule, SendsAtOnceThenEverySixteenPeriods) {
  DriveSchedule schedule;
  CurrentFrame frame;
  int sent = 0;
  for (int cycle = 0; cycle < 160; ++cycle) {
    const bool due = schedule.Due(frame);
    EXPECT_EQ(due, cycle % 16 == 0) << cycle;
    sent += due ? 1 : 0;
  }
  EXPECT_EQ(sent, 10);
}

TEST(DriveSchedule, SendsAChangeInItsOwnPeriod) {
  DriveSchedule schedule;
  CurrentFrame frame;
  for (int cycle = 0; cycle < 37; ++cycle) static_cast<void>(schedule.Due(frame));
  frame.bias_current_a = 1.0;
  EXPECT_TRUE(schedule.Due(frame));
}

TEST(DriveSchedule, NeverExceedsItsShareHoweverOftenTheSetPointMoves) {
  DriveSchedule schedule;
  CurrentFrame frame;
  int sent = 0;
  for (int cycle = 0; cycle < 1600; ++cycle) {
    frame.speed_set_point_rad_per_s += 1.0;
    sent += schedule.Due(frame) ? 1 : 0;
  }
  EXPECT_LE(sent, 102);  // 1600 / 16, and the burst of two
  EXPECT_GE(sent, 100);
}

}  // namespace
}  // namespace levitas::can
