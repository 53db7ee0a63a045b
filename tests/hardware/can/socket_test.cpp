// The sockets on a bus of the kernel: what arrives, what is dropped, what is said of a broken bus.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can/error.h>

#include "common/problem.hpp"
#include "hil/can_port/can_rig_link.hpp"
#include "hil/can_port/can_rig_port.hpp"
#include "hil/socketcan/link_kind.hpp"
#include "hil/socketcan/socket_can.hpp"
#include "rt/clock.hpp"
#include "tests/hardware/can/vcan.hpp"
#include "tests/unit/can/rigs.hpp"

namespace levitas::socketcan {
namespace {

using can::BusEvent;
using testing::HasSubstr;

constexpr std::int64_t kSecondNs = 1'000'000'000;

std::vector<can::BusConfig> Buses(const std::string& positions, const std::string& currents) {
  return {{"positions", positions, {1e6, 5e6}, can::Carries::kFromRig, 0.8},
          {"currents", currents, {1e6, 5e6}, can::Carries::kToRig, 0.8}};
}

class SocketTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!bus_.made()) GTEST_SKIP() << "this kernel has no vcan";
    rig_ = std::make_unique<SocketCan>(layout_, buses_, can::Sender::kRig);
    controller_ = std::make_unique<SocketCan>(layout_, buses_, can::Sender::kController);
  }
  can::WireFrame Positions(std::uint64_t cycle) {
    SensorFrame frame;
    frame.cycle = cycle;
    return codec_.Encode(can::ValuesOf(frame));
  }
  /// The next event that is not nothing, waiting at most a second.
  can::Reception Await() {
    for (;;) {
      const can::Reception reception = controller_->Next();
      if (reception.event != BusEvent::kNothing) return reception;
      if (!controller_->Wait(rt::MonotonicNowNs() + kSecondNs)) return reception;
    }
  }

  test::VirtualBus bus_{"vcan7"};
  std::vector<can::BusConfig> buses_ = Buses("vcan7", "vcan7");
  can::Layout layout_ = can::MakeLayout(can::TestRig(4), can::Format::kFd);
  can::MessageCodec codec_{can::MessageNamed(layout_, "RigPositions"), can::Format::kFd};
  std::unique_ptr<SocketCan> rig_;
  std::unique_ptr<SocketCan> controller_;
};

TEST_F(SocketTest, TwentyThousandFramesArriveInOrderAndUnchanged) {
  for (std::uint64_t cycle = 0; cycle < 20'000; ++cycle) {
    const can::WireFrame sent = Positions(cycle);
    ASSERT_EQ(rig_->Send(0, sent), can::SendResult::kSent);
    const can::Reception got = Await();
    ASSERT_EQ(got.event, BusEvent::kFrame);
    ASSERT_EQ(got.frame.id, sent.id);
    ASSERT_EQ(got.frame.length, sent.length);
    ASSERT_TRUE(got.frame.fd);
    ASSERT_EQ(got.frame.data, sent.data);
  }
  EXPECT_EQ(controller_->dropped(), 0U);
}

TEST_F(SocketTest, CarriesTheKernelsTimeStampOnTheMonotonicClock) {
  const std::int64_t before_ns = rt::MonotonicNowNs();
  rig_->Send(0, Positions(0));
  const can::Reception got = Await();
  const std::int64_t after_ns = rt::MonotonicNowNs();
  // The two clocks are read one behind the other, once: a microsecond apart at most.
  EXPECT_GE(got.frame.received_ns, before_ns - 1'000);
  EXPECT_LE(got.frame.received_ns, after_ns + 1'000);
}

TEST_F(SocketTest, NeverHearsItselfNorForeignIdentifiers) {
  const test::Intruder intruder("vcan7");
  can::WireFrame foreign = Positions(0);
  foreign.id = 0x111;
  intruder.Send(foreign);
  can::WireFrame own = Positions(0);
  own.id = can::kCurrentsId;
  controller_->Send(1, own);
  EXPECT_EQ(controller_->Next().event, BusEvent::kNothing);
}

TEST_F(SocketTest, WaitsUntilItsDeadlineAndNoLonger) {
  const std::int64_t deadline_ns = rt::MonotonicNowNs() + 5'000'000;
  EXPECT_FALSE(controller_->Wait(deadline_ns));
  EXPECT_GE(rt::MonotonicNowNs(), deadline_ns);
  EXPECT_FALSE(controller_->Wait(0));
}

TEST_F(SocketTest, TurnsErrorFramesOfTheChipIntoEvents) {
  const test::Intruder intruder("vcan7");
  intruder.SendError(CAN_ERR_BUSOFF);
  EXPECT_EQ(Await().event, BusEvent::kBusOff);
  intruder.SendError(CAN_ERR_RESTARTED);
  EXPECT_EQ(Await().event, BusEvent::kRestarted);
  intruder.SendError(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE);
  EXPECT_EQ(Await().event, BusEvent::kErrorPassive);
  intruder.SendError(CAN_ERR_PROT);
  EXPECT_EQ(Await().event, BusEvent::kProtocolError);
}

TEST_F(SocketTest, CountsFramesTheKernelHadToDrop) {
  // A frame occupies its sender's buffer until it is read, so several senders are needed to fill a
  // receiver's: 200 frames fit a sender's usual 208 kB, 20 senders fill any receiver's megabyte.
  constexpr std::uint64_t kSenders = 20;
  constexpr std::uint64_t kFrames = 200;
  std::vector<std::unique_ptr<test::Intruder>> senders;
  for (std::uint64_t sender = 0; sender < kSenders; ++sender) {
    senders.push_back(std::make_unique<test::Intruder>("vcan7"));
    for (std::uint64_t frame = 0; frame < kFrames; ++frame) senders.back()->Send(Positions(frame));
  }
  std::uint64_t read = 0;
  while (controller_->Wait(rt::MonotonicNowNs() + 1'000'000)) {
    while (controller_->Next().event == BusEvent::kFrame) ++read;
  }
  // The count comes with the next frame that is received.
  rig_->Send(0, Positions(0));
  ASSERT_EQ(Await().event, BusEvent::kFrame);
  EXPECT_LT(read, kSenders * kFrames);
  EXPECT_GT(controller_->dropped(), 0U);
  // Some were lost before they came to any socket, in the queue of the network layer.
  EXPECT_LE(controller_->dropped(), kSenders * kFrames - read);
}

TEST_F(SocketTest, SaysThatTheLinkWentDownAndWorksAgainWhenItIsUp) {
  bus_.Set("down");
  EXPECT_EQ(Await().event, BusEvent::kLinkDown);
  EXPECT_EQ(controller_->Send(1, Positions(0)), can::SendResult::kDown);
  bus_.Set("up");
  while (controller_->Next().event != BusEvent::kNothing) {
  }
  while (rig_->Next().event != BusEvent::kNothing) {
  }
  ASSERT_EQ(rig_->Send(0, Positions(1)), can::SendResult::kSent);
  EXPECT_EQ(Await().event, BusEvent::kFrame);
}

TEST_F(SocketTest, ABusThatCannotTakeMoreIsFullAndNobodyWaits) {
  if (!test::Shell("tc qdisc add dev vcan7 root tbf rate 8kbit burst 200 limit 400")) {
    GTEST_SKIP() << "this kernel has no tbf";
  }
  int full = 0;
  const std::int64_t start_ns = rt::MonotonicNowNs();
  for (std::uint64_t cycle = 0; cycle < 200; ++cycle) {
    full += rig_->Send(0, Positions(cycle)) == can::SendResult::kFull ? 1 : 0;
  }
  EXPECT_GT(full, 100);
  // 200 frames of 72 bytes take 14 s at this rate: whoever waited for them shows in virtual time.
  const std::int64_t took_ns = rt::MonotonicNowNs() - start_ns;
  if (std::string_view(std::getenv("LEVITAS_TEST_MACHINE")) == "virtual") {
    EXPECT_LT(took_ns, kSecondNs);
  }
}

std::string RefusalOf(const std::vector<can::BusConfig>& buses) {
  const can::Layout layout = can::MakeLayout(can::TestRig(4), can::Format::kFd);
  try {
    const SocketCan sockets(layout, buses, can::Sender::kRig);
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kOther);
    return problem.what();
  }
  return "not refused";
}

TEST(SocketRefusal, NamesTheRemedyForAnInterfaceThatIsNotThereDownOrWithoutFd) {
  const test::VirtualBus bus("vcan8", 16);
  if (!bus.made()) GTEST_SKIP() << "this kernel has no vcan";
  EXPECT_THAT(RefusalOf(Buses("nocan0", "nocan0")), HasSubstr("ip link add dev nocan0 type vcan"));
  EXPECT_THAT(RefusalOf(Buses("vcan8", "vcan8")), HasSubstr("ip link set vcan8 mtu 72 up"));
  bus.Set("down");
  EXPECT_THAT(RefusalOf(Buses("vcan8", "vcan8")), HasSubstr("it is down"));
}

TEST(TwoBuses, AreReadInTurnAndWrittenApart) {
  const test::VirtualBus first("vcan7");
  const test::VirtualBus second("vcan8");
  if (!second.made()) GTEST_SKIP() << "this kernel has no vcan";
  const can::Layout layout = can::MakeLayout(can::TestRig(4), can::Format::kFd);
  const auto buses = Buses("vcan7", "vcan8");
  SocketCan rig(layout, buses, can::Sender::kRig);
  SocketCan controller(layout, buses, can::Sender::kController);
  can_port::CanRigLink link(layout, buses, rig);
  can_port::CanRigPort port(layout, buses, {}, controller);
  for (std::uint64_t cycle = 0; cycle < 100; ++cycle) {
    ASSERT_TRUE(link.Send({.cycle = cycle, .axes = 4}));
    SensorFrame frame;
    ASSERT_EQ(port.Read(frame, rt::MonotonicNowNs() + kSecondNs), port::ReadResult::kFrame);
    ASSERT_TRUE(port.Write({.cycle = cycle, .axes = 4}));
    CurrentFrame current;
    ASSERT_EQ(link.Receive(current, rt::MonotonicNowNs() + kSecondNs),
              port::RigLink::ReceiveResult::kCurrent);
    ASSERT_EQ(current.cycle, cycle);
  }
}

TEST(LinkKindOfTheKernel, IsVirtualForVcanAndForBothEndsOfVxcan) {
  const test::VirtualBus bus("vcan6");
  const test::VirtualWire wire("vxa6", "vxb6");
  if (!bus.made() || !wire.made()) GTEST_SKIP() << "this kernel has no vcan or vxcan";
  for (const char* interface : {"vcan6", "vxa6", "vxb6"}) {
    EXPECT_EQ(FindLink(interface), LinkKind::kVirtual) << interface;
  }
}

}  // namespace
}  // namespace levitas::socketcan
