#pragma once
// Virtual buses of the kernel for tests, and a node on them that is nobody's friend.

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "hil/can/wire_frame.hpp"

namespace levitas::test {

inline bool Shell(const std::string& command) { return std::system(command.c_str()) == 0; }

/// Exists while the object does; `made()` says whether this kernel has vcan.
class VirtualBus {
 public:
  explicit VirtualBus(std::string name, int mtu = 72) : name_(std::move(name)) {
    Shell("ip link del " + name_ + " 2>/dev/null");
    made_ = Shell("ip link add dev " + name_ + " type vcan && ip link set " + name_ + " mtu " +
                  std::to_string(mtu) + " up");
  }
  ~VirtualBus() { Shell("ip link del " + name_ + " 2>/dev/null"); }
  VirtualBus(const VirtualBus&) = delete;
  VirtualBus& operator=(const VirtualBus&) = delete;

  [[nodiscard]] bool made() const { return made_; }
  void Set(const std::string& words) const {
    ASSERT_TRUE(Shell("ip link set " + name_ + " " + words)) << words;
  }

 private:
  std::string name_;
  bool made_{false};
};

/// Two interfaces that are the ends of one wire.
class VirtualWire {
 public:
  VirtualWire(const std::string& one, const std::string& other) : one_(one) {
    made_ = Shell("ip link add dev " + one + " type vxcan peer name " + other);
    for (const std::string& end : {one, other}) {
      made_ = made_ && Shell("ip link set " + end + " mtu 72 up");
    }
  }
  ~VirtualWire() { Shell("ip link del " + one_ + " 2>/dev/null"); }
  VirtualWire(const VirtualWire&) = delete;
  VirtualWire& operator=(const VirtualWire&) = delete;

  [[nodiscard]] bool made() const { return made_; }

 private:
  std::string one_;
  bool made_{false};
};

/// Writes whatever a test wants, error frames of the chip included.
class Intruder {
 public:
  explicit Intruder(const std::string& interface) {
    socket_ = socket(PF_CAN, SOCK_RAW, CAN_RAW);
    const int on = 1;
    setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof(on));
    setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
    bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  }
  ~Intruder() { close(socket_); }
  Intruder(const Intruder&) = delete;
  Intruder& operator=(const Intruder&) = delete;

  void Send(const can::WireFrame& frame) const {
    canfd_frame raw{};
    raw.can_id = frame.id;
    raw.len = frame.length;
    std::copy_n(frame.data.begin(), frame.length, &raw.data[0]);
    const std::size_t bytes = frame.fd ? CANFD_MTU : CAN_MTU;
    EXPECT_EQ(write(socket_, &raw, bytes), static_cast<ssize_t>(bytes));
  }
  void SendError(std::uint32_t kind, std::uint8_t controller = 0) const {
    can_frame raw{};
    raw.can_id = CAN_ERR_FLAG | kind;
    raw.can_dlc = kErrorLength;
    raw.data[1] = controller;
    EXPECT_EQ(write(socket_, &raw, sizeof(raw)), static_cast<ssize_t>(sizeof(raw)));
  }

 private:
  static constexpr unsigned char kErrorLength = 8;
  int socket_{-1};
};

}  // namespace levitas::test
