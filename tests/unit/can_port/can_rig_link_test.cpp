#include "hil/can_port/can_rig_link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hil/can_port/can_rig_port.hpp"
#include "tests/unit/can_port/fake_bus.hpp"

namespace levitas::can_port {
namespace {

using ReceiveResult = port::RigLink::ReceiveResult;

class CanRigLinkTest : public testing::TestWithParam<can::Format> {
 protected:
  CanRigLinkTest() {
    rig_bus_.other = &controller_bus_;
    controller_bus_.other = &rig_bus_;
  }
  static std::vector<can::BusConfig> Buses() {
    auto buses = TwoBuses();
    if (GetParam() == can::Format::kClassical) {
      for (auto& bus : buses) bus.rates.data_bit_per_s = 0.0;
    }
    return buses;
  }

  can::Layout layout_ = can::MakeLayout(can::TestRig(4), GetParam());
  FakeBus rig_bus_;
  FakeBus controller_bus_;
  CanRigLink link_{layout_, Buses(), rig_bus_};
  CanRigPort port_{layout_, Buses(), {}, controller_bus_};
};

TEST_P(CanRigLinkTest, TwentyThousandPeriodsPassWithoutALoss) {
  Random random(20261121);
  SensorFrame frame;
  for (std::uint64_t cycle = 0; cycle < 20'000; ++cycle) {
    SensorFrame sent = can::RandomSensorFrame(random, 4);
    sent.cycle = cycle;
    sent.rig_session = 7;
    link_.Send(sent);
    ASSERT_EQ(port_.Read(frame, 0), port::ReadResult::kFrame);
    ASSERT_EQ(frame.cycle, cycle);
    for (std::size_t axis = 0; axis < 4; ++axis) {
      ASSERT_NEAR(frame.position_m[axis], sent.position_m[axis], 5.001e-9);
    }
    CurrentFrame current = can::RandomCurrentFrame(random, 4);
    current.cycle = cycle;
    port_.Write(current);
    CurrentFrame got;
    ASSERT_EQ(link_.Receive(got, 0), ReceiveResult::kCurrent);
    ASSERT_EQ(got.cycle, cycle);
    ASSERT_EQ(got.amplifiers_enabled, current.amplifiers_enabled);
    for (std::size_t axis = 0; axis < 4; ++axis) {
      ASSERT_NEAR(got.control_current_a[axis], current.control_current_a[axis], 5.001e-5);
    }
    rig_bus_.sent.clear();
    controller_bus_.sent.clear();
  }
  EXPECT_EQ(port_.counters().frames_lost + link_.counters().currents_lost, 0U);
  EXPECT_EQ(port_.counters().frames_rejected + link_.counters().currents_rejected, 0U);
}

INSTANTIATE_TEST_SUITE_P(Formats, CanRigLinkTest,
                         testing::Values(can::Format::kFd, can::Format::kClassical));

class RigEnd : public CanRigLinkTest {};

TEST_P(RigEnd, HoldsBackCurrentsOfABusThatIsOff) {
  link_.Send({.cycle = 3, .axes = 4});
  rig_bus_.Event(can::BusEvent::kBusOff, 1);
  port_.Write({.cycle = 3, .axes = 4});
  CurrentFrame got;
  EXPECT_EQ(link_.Receive(got, 0), ReceiveResult::kNothing);
  EXPECT_FALSE(link_.Send({.cycle = 4, .axes = 4}));
  EXPECT_EQ(link_.counters().send_failures, 1U);
  EXPECT_THAT(link_.Trouble(), testing::HasSubstr("1 x bus off"));
}

TEST_P(RigEnd, CountsDamagedCurrents) {
  link_.Send({.cycle = 3, .axes = 4});
  port_.Write({.cycle = 3, .axes = 4});
  rig_bus_.arrived.back().frame.data[2] ^= 1U;
  CurrentFrame got;
  EXPECT_EQ(link_.Receive(got, 0), ReceiveResult::kNothing);
  EXPECT_EQ(link_.counters().currents_rejected, 1U);
}

INSTANTIATE_TEST_SUITE_P(Fd, RigEnd, testing::Values(can::Format::kFd));

}  // namespace
}  // namespace levitas::can_port
