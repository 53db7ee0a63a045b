#include "hil/socketcan/raw_socket.hpp"

#include <fmt/core.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "common/problem.hpp"

namespace levitas::socketcan {
namespace {

constexpr std::size_t kBatch = 8;
constexpr std::size_t kControlBytes = 128;
constexpr int kReceiveBuffer = 1 << 20;  // [byte] a tenth of a second and more of 10 kHz
constexpr can_err_mask_t kErrors = CAN_ERR_BUSOFF | CAN_ERR_RESTARTED | CAN_ERR_CRTL |
                                   CAN_ERR_PROT | CAN_ERR_ACK | CAN_ERR_TX_TIMEOUT |
                                   CAN_ERR_BUSERROR;

template <class T>
bool Set(int socket, int level, int option, const T* value, std::size_t count = 1) {
  return setsockopt(socket, level, option, value, static_cast<socklen_t>(sizeof(T) * count)) == 0;
}

[[noreturn]] void Fail(const std::string& interface, const std::string& what) {
  throw Problem(ExitStatus::kOther, fmt::format("CAN interface {}: {}", interface, what));
}

std::int64_t Nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

void RequireUsable(int socket, const std::string& interface, bool fd) {
  ifreq request{};
  std::copy_n(interface.c_str(), std::min<std::size_t>(interface.size(), IFNAMSIZ - 1),
              &request.ifr_name[0]);
  if (ioctl(socket, SIOCGIFFLAGS, &request) == 0 && (request.ifr_flags & IFF_UP) == 0) {
    Fail(interface, fmt::format("it is down: sudo ip link set {} up", interface));
  }
  if (fd && ioctl(socket, SIOCGIFMTU, &request) == 0 && request.ifr_mtu < int{CANFD_MTU}) {
    Fail(
        interface,
        fmt::format("no CAN FD: sudo ip link set {0} down; then for vcan: sudo ip link set {0} mtu "
                    "72 up; for a chip: sudo ip link set {0} up type can bitrate 1000000 dbitrate "
                    "5000000 fd on",
                    interface));
  }
}

}  // namespace

can::BusEvent EventOf(const canfd_frame& error) noexcept {
  using can::BusEvent;
  const canid_t kind = error.can_id & CAN_ERR_MASK;
  if ((kind & CAN_ERR_BUSOFF) != 0) return BusEvent::kBusOff;
  if ((kind & CAN_ERR_RESTARTED) != 0) return BusEvent::kRestarted;
  if ((kind & CAN_ERR_CRTL) != 0) {
    const unsigned detail = error.data[1];
    if ((detail & (CAN_ERR_CRTL_RX_OVERFLOW | CAN_ERR_CRTL_TX_OVERFLOW)) != 0) {
      return BusEvent::kChipOverrun;
    }
    if ((detail & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0) {
      return BusEvent::kErrorPassive;
    }
    if ((detail & CAN_ERR_CRTL_ACTIVE) != 0) return BusEvent::kErrorActive;
  }
  return BusEvent::kProtocolError;
}

// Storage for one recvmmsg.
struct RawSocket::Batch {
  Batch() {
    for (std::size_t at = 0; at < kBatch; ++at) {
      pieces[at] = {&frames[at], sizeof(canfd_frame)};
      messages[at].msg_hdr.msg_iov = &pieces[at];
      messages[at].msg_hdr.msg_iovlen = 1;
      messages[at].msg_hdr.msg_control = control[at].data();
    }
  }
  std::array<canfd_frame, kBatch> frames{};
  std::array<iovec, kBatch> pieces{};
  struct alignas(cmsghdr) Control : std::array<std::uint8_t, kControlBytes> {};
  std::array<Control, kBatch> control{};
  std::array<mmsghdr, kBatch> messages{};
  std::size_t filled{0};
  std::size_t taken{0};
};

RawSocket::RawSocket(const std::string& interface, bool fd, const std::vector<std::uint32_t>& ids)
    : socket_(socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW)),
      batch_(std::make_unique<Batch>()) {
  if (socket_ < 0) {
    Fail(interface, fmt::format("no CAN sockets in this kernel ({}): sudo modprobe -a can can_raw; "
                                "amb doctor says more",
                                std::strerror(errno)));
  }
  try {
    Configure(interface, fd, ids);
  } catch (...) {
    close(socket_);
    throw;
  }
  ReadClocks();
}

RawSocket::~RawSocket() { close(socket_); }

void RawSocket::Configure(const std::string& interface, bool fd,
                          const std::vector<std::uint32_t>& ids) {
  const unsigned index = if_nametoindex(interface.c_str());
  if (index == 0) {
    Fail(interface,
         fmt::format("not there; a virtual one: sudo ip link add dev {0} type vcan; sudo "
                     "ip link set {0} mtu 72 up",
                     interface));
  }
  RequireUsable(socket_, interface, fd);
  std::vector<can_filter> filters;
  filters.reserve(ids.size());
  for (const std::uint32_t id : ids) {
    filters.push_back({id, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  const int on = 1;
  const can_err_mask_t errors = kErrors;
  // An empty filter list receives nothing but errors, which is what a bus that only sends wants.
  const bool good =
      (!fd || Set(socket_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on)) &&
      setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FILTER, filters.empty() ? nullptr : filters.data(),
                 static_cast<socklen_t>(filters.size() * sizeof(can_filter))) == 0 &&
      Set(socket_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors) &&
      Set(socket_, SOL_SOCKET, SO_TIMESTAMPNS, &on) && Set(socket_, SOL_SOCKET, SO_RXQ_OVFL, &on);
  if (!good) Fail(interface, fmt::format("setsockopt: {}", std::strerror(errno)));
  // As far as the machine allows; what does not fit is counted.
  static_cast<void>(Set(socket_, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer));
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    Fail(interface, fmt::format("bind: {}", std::strerror(errno)));
  }
}

void RawSocket::ReadClocks() noexcept {
  timespec before{};
  timespec real{};
  timespec after{};
  clock_gettime(CLOCK_MONOTONIC, &before);
  clock_gettime(CLOCK_REALTIME, &real);
  clock_gettime(CLOCK_MONOTONIC, &after);
  clock_.Read(Nanoseconds(before), Nanoseconds(real), Nanoseconds(after));
}

void RawSocket::ReadControl(std::size_t at, can::WireFrame& frame) noexcept {
  msghdr& header = batch_->messages[at].msg_hdr;
  for (cmsghdr* item = CMSG_FIRSTHDR(&header); item != nullptr; item = CMSG_NXTHDR(&header, item)) {
    if (item->cmsg_level != SOL_SOCKET) continue;
    if (item->cmsg_type == SO_TIMESTAMPNS) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(item), sizeof(stamp));
      frame.received_ns = clock_.Monotonic(Nanoseconds(stamp));
    } else if (item->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t overflow = 0;  // since the socket was made, modulo 2^32
      std::memcpy(&overflow, CMSG_DATA(item), sizeof(overflow));
      dropped_ += overflow - last_overflow_;
      last_overflow_ = overflow;
    }
  }
}

can::Reception RawSocket::Translate(std::size_t at) noexcept {
  const canfd_frame& raw = batch_->frames[at];
  const unsigned bytes = batch_->messages[at].msg_len;
  can::Reception reception;
  if ((raw.can_id & CAN_ERR_FLAG) != 0) {
    reception.event = EventOf(raw);
    return reception;
  }
  if (bytes != CAN_MTU && bytes != CANFD_MTU) return reception;
  reception.event = can::BusEvent::kFrame;
  can::WireFrame& frame = reception.frame;
  frame.id = raw.can_id & CAN_SFF_MASK;
  frame.fd = bytes == CANFD_MTU;
  frame.length = std::min<std::uint8_t>(raw.len, frame.fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN);
  std::copy_n(&raw.data[0], frame.length, frame.data.begin());
  ReadControl(at, frame);
  return reception;
}

can::Reception RawSocket::Next() noexcept {
  Batch& batch = *batch_;
  for (;;) {
    while (batch.taken < batch.filled) {
      const can::Reception reception = Translate(batch.taken++);
      if (reception.event != can::BusEvent::kNothing) return reception;
    }
    // A batch that was not full emptied the socket: the next call would find nothing.
    if (batch.filled > 0 && batch.filled < kBatch) {
      clock_.Emptied();
      batch.filled = 0;
      batch.taken = 0;
      return {};
    }
    for (auto& message : batch.messages) message.msg_hdr.msg_controllen = kControlBytes;
    const int count = recvmmsg(socket_, batch.messages.data(), kBatch, MSG_DONTWAIT, nullptr);
    batch.taken = 0;
    batch.filled = count > 0 ? static_cast<std::size_t>(count) : 0;
    if (count > 0) {
      ReadClocks();
      continue;
    }
    can::Reception none;
    if (count < 0 && errno != EAGAIN && errno != EINTR) none.event = can::BusEvent::kLinkDown;
    return none;
  }
}

can::SendResult RawSocket::Send(const can::WireFrame& frame) noexcept {
  canfd_frame raw{};
  raw.can_id = frame.id;
  raw.len = frame.length;
  raw.flags = frame.fd ? CANFD_BRS : 0;
  std::copy_n(frame.data.begin(), frame.length, &raw.data[0]);
  const std::size_t bytes = frame.fd ? CANFD_MTU : CAN_MTU;
  if (send(socket_, &raw, bytes, MSG_DONTWAIT) == static_cast<ssize_t>(bytes)) {
    return can::SendResult::kSent;
  }
  return errno == ENOBUFS || errno == EAGAIN ? can::SendResult::kFull : can::SendResult::kDown;
}

}  // namespace levitas::socketcan
