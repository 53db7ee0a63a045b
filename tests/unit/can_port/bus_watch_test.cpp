#include "hil/can_port/bus_watch.hpp"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>

#include "hil/socketcan/raw_socket.hpp"

namespace levitas::can_port {
namespace {

using can::BusEvent;

TEST(BusWatch, HoldsABusOffUntilItsOwnRestart) {
  BusWatch watch;
  watch.Note({BusEvent::kBusOff, 1, {}});
  EXPECT_TRUE(watch.Off(1));
  EXPECT_FALSE(watch.Off(0));
  watch.Note({BusEvent::kRestarted, 0, {}});
  EXPECT_TRUE(watch.AnyOff());
  watch.Note({BusEvent::kRestarted, 1, {}});
  EXPECT_FALSE(watch.AnyOff());
}

TEST(BusWatch, IsBackWhenTheChipIsErrorActive) {
  BusWatch watch;
  watch.Note({BusEvent::kBusOff, 1, {}});
  watch.Note({BusEvent::kErrorActive, 1, {}});
  EXPECT_FALSE(watch.AnyOff());
}

// ip link set can0 down; ip link set can0 up: the chip starts anew, and says nothing of a restart.
TEST(BusWatch, IsBackAfterTheLinkWasTakenDown) {
  BusWatch watch;
  watch.Note({BusEvent::kBusOff, 1, {}});
  watch.Note({BusEvent::kLinkDown, 0, {}});
  EXPECT_TRUE(watch.Off(1));
  watch.Note({BusEvent::kLinkDown, 1, {}});
  EXPECT_FALSE(watch.AnyOff());
}

// A trip after frame_missing_cycles, 10 as shipped, comes first.
TEST(BusWatch, IsBackWhenFramesKeepComingThoughTheDriverSaysNothing) {
  BusWatch watch;
  for (int time = 1; time <= 2; ++time) {
    watch.Note({BusEvent::kBusOff, 1, {}});
    EXPECT_TRUE(watch.Hears(0));
    for (std::uint32_t frame = 1; frame < BusWatch::kBackAfter; ++frame) {
      EXPECT_FALSE(watch.Hears(1)) << frame;
    }
    EXPECT_TRUE(watch.Hears(1));
    EXPECT_FALSE(watch.AnyOff());
  }
  EXPECT_EQ(watch.counters().returns, 2U);
}

TEST(BusWatch, SaysNothingWhenNothingHappened) { EXPECT_EQ(Text(BusCounters{}, 0), ""); }

TEST(BusWatch, NamesEveryKindWithItsCount) {
  BusWatch watch;
  watch.Note({BusEvent::kLinkDown, 0, {}});
  watch.Note(can::SendResult::kFull);
  watch.Note(can::SendResult::kFull);
  watch.Note(can::SendResult::kDown);
  EXPECT_EQ(Text(watch.counters(), 3),
            "1 x link down; 2 x frame the bus could not take (ENOBUFS); 1 x frame without a link; "
            "3 x frame dropped by the kernel, read too late");
}

canfd_frame ErrorFrame(std::uint32_t kind, std::uint8_t controller = 0) {
  canfd_frame frame{};
  frame.can_id = CAN_ERR_FLAG | kind;
  frame.len = CAN_ERR_DLC;
  frame.data[1] = controller;
  return frame;
}

TEST(ErrorFrames, OfTheKernelBecomeEvents) {
  using socketcan::EventOf;
  EXPECT_EQ(EventOf(ErrorFrame(CAN_ERR_BUSOFF)), BusEvent::kBusOff);
  EXPECT_EQ(EventOf(ErrorFrame(CAN_ERR_RESTARTED)), BusEvent::kRestarted);
  EXPECT_EQ(EventOf(ErrorFrame(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE)), BusEvent::kErrorPassive);
  EXPECT_EQ(EventOf(ErrorFrame(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE)), BusEvent::kErrorPassive);
  EXPECT_EQ(EventOf(ErrorFrame(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW)), BusEvent::kChipOverrun);
  EXPECT_EQ(EventOf(ErrorFrame(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE)), BusEvent::kErrorActive);
  EXPECT_EQ(EventOf(ErrorFrame(CAN_ERR_PROT)), BusEvent::kProtocolError);
  EXPECT_EQ(EventOf(ErrorFrame(CAN_ERR_ACK)), BusEvent::kProtocolError);
}

}  // namespace
}  // namespace levitas::can_port
