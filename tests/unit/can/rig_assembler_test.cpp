// The controller's end: loss, repetition, order, restarts, damage.

#include <gtest/gtest.h>

#include "hil/can/assemblers.hpp"
#include "tests/unit/can/rigs.hpp"

namespace levitas::can {
namespace {

/// A rig that sends positions, and the end that takes them.
class RigAssemblerTest : public testing::Test {
 protected:
  WireFrame Send(std::uint64_t cycle, std::uint32_t session = 1) {
    SensorFrame frame;
    frame.cycle = cycle;
    frame.rig_session = session;
    frame.position_m[0] = static_cast<double>(cycle % 1000) * 1e-8;
    return codec_.Encode(ValuesOf(frame));
  }
  Outcome Take(const WireFrame& wire) { return assembler_.Take(wire, frame_); }

  Layout layout_ = MakeLayout(TestRig(4), Format::kFd);
  MessageCodec codec_{MessageNamed(layout_, "RigPositions"), Format::kFd};
  RigAssembler assembler_{layout_};
  SensorFrame frame_;
};

TEST_F(RigAssemblerTest, CompletesTheCycleOverManyTurnsOfItsTwelveBits) {
  for (std::uint64_t cycle = 0; cycle < 20'000; ++cycle) {
    ASSERT_EQ(Take(Send(cycle)), Outcome::kFrame);
    ASSERT_EQ(frame_.cycle, cycle);
    ASSERT_NEAR(frame_.position_m[0], static_cast<double>(cycle % 1000) * 1e-8, 1e-15);
  }
  EXPECT_EQ(assembler_.lost(), 0U);
  EXPECT_EQ(frame_.rig_session, 1U);
  EXPECT_EQ(frame_.axes, 4U);
}

TEST_F(RigAssemblerTest, CountsEveryLostFrame) {
  std::uint64_t lost = 0;
  std::uint64_t cycle = 0;
  Random random(20261121);
  ASSERT_EQ(Take(Send(0)), Outcome::kFrame);
  for (int frame = 0; frame < 5000; ++frame) {
    const std::uint64_t gap = random.Bits() % 5 == 0 ? random.Bits() % 200 : 0;
    for (std::uint64_t skip = 0; skip < gap; ++skip) Send(cycle + 1 + skip);
    cycle += gap + 1;
    lost += gap;
    ASSERT_EQ(Take(Send(cycle)), Outcome::kFrame);
    ASSERT_EQ(frame_.cycle, cycle);
  }
  EXPECT_EQ(assembler_.lost(), lost);
}

TEST_F(RigAssemblerTest, IgnoresACopyButPassesOnThatTheRigAsksAgain) {
  const WireFrame first = Send(5);
  EXPECT_EQ(Take(first), Outcome::kFrame);
  EXPECT_EQ(Take(first), Outcome::kRepeated);
  EXPECT_EQ(Take(Send(5)), Outcome::kFrame);  // another counter: asked again
  EXPECT_EQ(frame_.cycle, 5U);
  EXPECT_EQ(assembler_.lost(), 0U);
}

TEST_F(RigAssemblerTest, RefusesFramesThatComeBehindLaterOnes) {
  const WireFrame early = Send(10);
  EXPECT_EQ(Take(Send(11)), Outcome::kFrame);
  EXPECT_EQ(Take(early), Outcome::kOutOfOrder);
  EXPECT_EQ(frame_.cycle, 11U);
  EXPECT_EQ(Take(Send(12)), Outcome::kFrame);
  EXPECT_NEAR(frame_.position_m[0], 12e-8, 1e-15);
}

TEST_F(RigAssemblerTest, RefusesReplayedFramesOneByOne) {
  std::vector<WireFrame> old;
  old.reserve(100);
  for (std::uint64_t cycle = 0; cycle < 100; ++cycle) {
    old.push_back(Send(cycle));
    ASSERT_EQ(Take(old.back()), Outcome::kFrame);
  }
  // A frame of long ago now and then, among the true ones.
  for (std::uint64_t cycle = 100; cycle < 200; ++cycle) {
    ASSERT_EQ(Take(old[(cycle * 7) % 100]), Outcome::kOutOfOrder);
    ASSERT_EQ(Take(Send(cycle)), Outcome::kFrame);
    ASSERT_EQ(frame_.cycle, cycle);
    ASSERT_EQ(frame_.rig_session, 1U);
  }
}

TEST_F(RigAssemblerTest, TakesAnotherSessionNumberForARestart) {
  ASSERT_EQ(Take(Send(900, 1)), Outcome::kFrame);
  ASSERT_EQ(Take(Send(0, 3)), Outcome::kFrame);
  EXPECT_EQ(frame_.rig_session, 2U);
  EXPECT_EQ(frame_.cycle, 0U);
}

TEST_F(RigAssemblerTest, FindsARestartUnderTheSameSessionNumberByItsCount) {
  for (std::uint64_t cycle = 0; cycle < 600; ++cycle) ASSERT_EQ(Take(Send(cycle)), Outcome::kFrame);
  EXPECT_EQ(Take(Send(0)), Outcome::kOutOfOrder);
  EXPECT_EQ(Take(Send(1)), Outcome::kOutOfOrder);
  EXPECT_EQ(Take(Send(2)), Outcome::kFrame);  // the third that follows the one before
  EXPECT_EQ(frame_.rig_session, 2U);
  EXPECT_EQ(frame_.cycle, 2U);
}

TEST_F(RigAssemblerTest, TakesAJumpAheadForARestart) {
  ASSERT_EQ(Take(Send(100)), Outcome::kFrame);
  ASSERT_EQ(Take(Send(100 + RigAssembler::kLongestGap + 1)), Outcome::kFrame);
  EXPECT_EQ(frame_.rig_session, 2U);
}

TEST_F(RigAssemblerTest, CountsWhatItRefuses) {
  WireFrame damaged = Send(1);
  damaged.data[7] ^= 0x10U;
  EXPECT_EQ(Take(damaged), Outcome::kDamaged);
  WireFrame foreign = Send(2);
  foreign.id = 0x7FF;
  EXPECT_EQ(Take(foreign), Outcome::kForeign);
  EXPECT_EQ(assembler_.outcomes()[Outcome::kDamaged], 1U);
  EXPECT_EQ(assembler_.outcomes()[Outcome::kForeign], 1U);
  EXPECT_EQ(assembler_.outcomes()[Outcome::kFrame], 0U);
}

TEST_F(RigAssemblerTest, IsDeafToItsOwnKindOfMessage) {
  MessageCodec currents(MessageNamed(layout_, "ControllerCurrents"), Format::kFd);
  EXPECT_EQ(Take(currents.Encode({})), Outcome::kForeign);
}

class ClassicalAssembler : public testing::Test {
 protected:
  WireFrame Send(MessageCodec& codec, std::uint64_t cycle, double angle_rad = 0.0) {
    SensorFrame frame;
    frame.cycle = cycle;
    frame.rig_session = 1;
    frame.position_m = {1e-6, 2e-6, 3e-6, 4e-6};
    frame.speed_rad_per_s = 100.0;
    frame.angle_rad = angle_rad;
    return codec.Encode(ValuesOf(frame));
  }

  Layout layout_ = MakeLayout(TestRig(4), Format::kClassical);
  MessageCodec first_{MessageNamed(layout_, "RigPositions1"), Format::kClassical};
  MessageCodec second_{MessageNamed(layout_, "RigPositions2"), Format::kClassical};
  MessageCodec rotation_{MessageNamed(layout_, "RigRotation"), Format::kClassical};
  RigAssembler assembler_{layout_};
  SensorFrame frame_;
};

TEST_F(ClassicalAssembler, PutsAFrameTogetherFromItsPartsInAnyOrder) {
  EXPECT_EQ(assembler_.Take(Send(first_, 1), frame_), Outcome::kPart);
  EXPECT_EQ(assembler_.Take(Send(second_, 1), frame_), Outcome::kFrame);
  EXPECT_EQ(assembler_.Take(Send(second_, 2), frame_), Outcome::kPart);
  EXPECT_EQ(assembler_.Take(Send(first_, 2), frame_), Outcome::kFrame);
  EXPECT_EQ(frame_.cycle, 2U);
  EXPECT_NEAR(frame_.position_m[3], 4e-6, 1e-12);
}

TEST_F(ClassicalAssembler, NeverMixesPartsOfTwoCycles) {
  EXPECT_EQ(assembler_.Take(Send(first_, 1), frame_), Outcome::kPart);
  EXPECT_EQ(assembler_.Take(Send(second_, 2), frame_), Outcome::kPart);
  EXPECT_EQ(assembler_.Take(Send(first_, 2), frame_), Outcome::kFrame);
  EXPECT_EQ(assembler_.lost(), 1U);
}

TEST_F(ClassicalAssembler, TurnsTheAngleOnBetweenMessagesOfRotation) {
  EXPECT_EQ(assembler_.Take(Send(rotation_, 0, 1.0), frame_), Outcome::kPart);
  for (std::uint64_t cycle = 0; cycle < 4; ++cycle) {
    EXPECT_EQ(assembler_.Take(Send(first_, cycle), frame_), Outcome::kPart);
    EXPECT_EQ(assembler_.Take(Send(second_, cycle), frame_), Outcome::kFrame);
    // 100 rad/s for 100 us a cycle; the angle's own step is 1e-4 rad.
    EXPECT_NEAR(frame_.angle_rad, 1.0 + 0.01 * static_cast<double>(cycle), 5e-5);
  }
}

}  // namespace
}  // namespace levitas::can
