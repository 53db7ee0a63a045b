// transport_pingpong TRANSPORT SECONDS [SPIN_US]: two processes exchange messages of the size of a
// sensor frame and a current frame as fast as they can; prints exchanges per second.
//
//   udp     raw UDP over loopback, one unicast socket each; the yardstick
//   own     LCM short messages on this project's multicast sockets, encoded and decoded
//   liblcm  the same messages through liblcm (C interface), one port per direction
//
// SPIN_US 0 waits in the kernel; otherwise each wait first polls for so long (liblcm: not
// possible).

#include <arpa/inet.h>
#include <fcntl.h>
#include <lcm/lcm.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include "rt/clock.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/lcm_rig_link.hpp"
#include "transport/lcm_rig_port.hpp"

namespace levitas::transport {
namespace {

constexpr std::size_t kAxes = 4;
constexpr std::int64_t kPatienceNs = 100'000'000;

/// Half of an exchange as one process sees it.
class Side {
 public:
  virtual ~Side() = default;
  virtual void Send() = 0;
  virtual bool Receive() = 0;  ///< false when nothing came for 0.1 s
};

sockaddr_in Loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

class UdpSide final : public Side {
 public:
  UdpSide(std::uint16_t own, std::uint16_t other, std::size_t size, std::int64_t spin_ns)
      : size_(size), spin_ns_(spin_ns) {
    socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    const sockaddr_in here = Loopback(own);
    const sockaddr_in there = Loopback(other);
    if (bind(socket_, reinterpret_cast<const sockaddr*>(&here), sizeof(here)) != 0 ||
        connect(socket_, reinterpret_cast<const sockaddr*>(&there), sizeof(there)) != 0) {
      std::perror("udp");
      std::exit(1);
    }
  }
  ~UdpSide() override { close(socket_); }
  void Send() override { (void)!send(socket_, data_.data(), size_, 0); }
  bool Receive() override {
    const std::int64_t until_ns = rt::MonotonicNowNs() + spin_ns_;
    do {
      if (recv(socket_, data_.data(), data_.size(), 0) > 0) return true;
    } while (spin_ns_ > 0 && rt::MonotonicNowNs() < until_ns);
    pollfd readable{socket_, POLLIN, 0};
    return poll(&readable, 1, 100) > 0 && recv(socket_, data_.data(), data_.size(), 0) > 0;
  }

 private:
  int socket_;
  std::size_t size_;
  std::int64_t spin_ns_;
  std::array<std::uint8_t, 2048> data_{};
};

class OwnController final : public Side {
 public:
  explicit OwnController(std::int64_t spin_ns) : port_({}, kAxes, spin_ns) {}
  void Send() override { (void)port_.Write(answer_); }
  bool Receive() override {
    return port_.Read(frame_, rt::MonotonicNowNs() + kPatienceNs) == port::ReadResult::kFrame;
  }

 private:
  LcmRigPort port_;
  SensorFrame frame_;
  CurrentFrame answer_;
};

class OwnRig final : public Side {
 public:
  explicit OwnRig(std::int64_t spin_ns) : link_({}, kAxes, spin_ns) {}
  void Send() override { (void)link_.Send(frame_); }
  bool Receive() override {
    return link_.Receive(answer_, rt::MonotonicNowNs() + kPatienceNs) ==
           LcmRigLink::ReceiveResult::kCurrent;
  }

 private:
  LcmRigLink link_;
  SensorFrame frame_;
  CurrentFrame answer_;
};

/// liblcm as it is meant to be used: unlimited queue, one port per direction, one thread.
class LibLcmSide final : public Side {
 public:
  LibLcmSide(Direction out, Direction in, const char* out_channel, const char* in_channel,
             std::span<const std::uint8_t> payload)
      : out_(lcm_create(LcmNetwork{}.Url(out).c_str())),
        in_(lcm_create(LcmNetwork{}.Url(in).c_str())),
        channel_(out_channel),
        payload_(payload.begin(), payload.end()) {
    if (out_ == nullptr || in_ == nullptr) std::exit(1);
    lcm_subscription_t* subscription = lcm_subscribe(
        in_, in_channel,
        [](const lcm_recv_buf_t*, const char*, void* got) { *static_cast<bool*>(got) = true; },
        &got_);
    lcm_subscription_set_queue_capacity(subscription, 0);
  }
  ~LibLcmSide() override {
    lcm_destroy(out_);
    lcm_destroy(in_);
  }
  void Send() override {
    lcm_publish(out_, channel_, payload_.data(), static_cast<unsigned>(payload_.size()));
  }
  bool Receive() override {
    got_ = false;
    return lcm_handle_timeout(in_, 100) > 0 && got_;
  }

 private:
  lcm_t* out_;
  lcm_t* in_;
  const char* channel_;
  std::vector<std::uint8_t> payload_;
  bool got_{false};
};

std::unique_ptr<Side> Make(const std::string& transport, bool rig, std::int64_t spin_ns) {
  SensorFrameCodec sensor(kAxes);
  CurrentFrameCodec current(kAxes);
  const auto out = rig ? sensor.Encode({}) : current.Encode({});
  if (transport == "udp") {
    return rig ? std::make_unique<UdpSide>(17001, 17002, out.size(), spin_ns)
               : std::make_unique<UdpSide>(17002, 17001, out.size(), spin_ns);
  }
  if (transport == "own") {
    if (rig) return std::make_unique<OwnRig>(spin_ns);
    return std::make_unique<OwnController>(spin_ns);
  }
  const auto payload = ParsePacket(out).payload;
  if (rig) {
    return std::make_unique<LibLcmSide>(Direction::kSensor, Direction::kCurrent, channel::kSensor,
                                        channel::kCurrent, payload);
  }
  return std::make_unique<LibLcmSide>(Direction::kCurrent, Direction::kSensor, channel::kCurrent,
                                      channel::kSensor, payload);
}

// The controller's side only answers; it is ended with a signal.
[[noreturn]] void Answer(const std::string& transport, std::int64_t spin_ns) {
  const auto side = Make(transport, false, spin_ns);
  for (;;) {
    if (side->Receive()) side->Send();
  }
}

double Measure(const std::string& transport, double seconds, std::int64_t spin_ns) {
  const auto side = Make(transport, true, spin_ns);
  const auto exchange = [&side] {
    side->Send();
    return side->Receive();
  };
  while (!exchange()) {  // until the other process listens
  }
  const std::int64_t start_ns = rt::MonotonicNowNs();
  const auto end_ns = start_ns + static_cast<std::int64_t>(seconds * 1e9);
  std::uint64_t exchanges = 0;
  while (rt::MonotonicNowNs() < end_ns) exchanges += exchange() ? 1U : 0U;
  return static_cast<double>(exchanges) /
         (static_cast<double>(rt::MonotonicNowNs() - start_ns) * 1e-9);
}

}  // namespace
}  // namespace levitas::transport

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: transport_pingpong udp|own|liblcm SECONDS [SPIN_US]\n");
    return 2;
  }
  const std::string transport = argv[1];
  const double seconds = std::atof(argv[2]);
  const std::int64_t spin_ns = argc > 3 ? std::atol(argv[3]) * 1000 : 0;
  const pid_t child = fork();
  if (child == 0) levitas::transport::Answer(transport, spin_ns);
  const double rate = levitas::transport::Measure(transport, seconds, spin_ns);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  std::printf("%.0f\n", rate);
  return 0;
}
