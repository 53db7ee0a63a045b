#include "hil/socketcan/socket_can.hpp"

#include <poll.h>

#include <algorithm>

#include "hil/socketcan/raw_socket.hpp"
#include "rt/clock.hpp"

namespace levitas::socketcan {

namespace {
constexpr std::int64_t kShortWaitNs = 25'000;  // a sleep costs more than this
}  // namespace

struct SocketCan::Impl {
  std::vector<std::unique_ptr<RawSocket>> sockets;
  std::vector<std::size_t> socket_of_bus;
  std::vector<pollfd> polled;
  std::size_t turn{0};  // where the next look begins: no bus can starve another

  [[nodiscard]] int Poll(std::int64_t limit_ns) noexcept {
    const timespec limit{static_cast<time_t>(limit_ns / 1'000'000'000),
                         static_cast<long>(limit_ns % 1'000'000'000)};
    return ppoll(polled.data(), polled.size(), &limit, nullptr);
  }
};

SocketCan::SocketCan(const can::Layout& layout, const std::vector<can::BusConfig>& buses,
                     std::optional<can::Sender> own)
    : impl_(std::make_unique<Impl>()) {
  std::vector<std::string> interfaces;
  for (const can::BusConfig& bus : buses) {
    const auto known = std::find(interfaces.begin(), interfaces.end(), bus.interface);
    impl_->socket_of_bus.push_back(static_cast<std::size_t>(known - interfaces.begin()));
    if (known == interfaces.end()) interfaces.push_back(bus.interface);
  }
  std::vector<std::vector<std::uint32_t>> ids(interfaces.size());
  for (const can::Message& message : layout.messages) {
    if (message.sender == own) continue;
    ids[impl_->socket_of_bus[can::BusOf(message, buses)]].push_back(message.id);
  }
  for (std::size_t at = 0; at < interfaces.size(); ++at) {
    impl_->sockets.push_back(
        std::make_unique<RawSocket>(interfaces[at], layout.format == can::Format::kFd, ids[at]));
    impl_->polled.push_back({impl_->sockets.back()->descriptor(), POLLIN, 0});
  }
}

SocketCan::~SocketCan() = default;

can::Reception SocketCan::Next() noexcept {
  const std::size_t count = impl_->sockets.size();
  for (std::size_t look = 0; look < count; ++look) {
    const std::size_t at = (impl_->turn + look) % count;
    can::Reception reception = impl_->sockets[at]->Next();
    if (reception.event == can::BusEvent::kNothing) continue;
    reception.socket = at;
    impl_->turn = at;
    return reception;
  }
  return {};
}

can::SendResult SocketCan::Send(std::size_t bus, const can::WireFrame& frame) noexcept {
  return impl_->sockets[impl_->socket_of_bus[bus]]->Send(frame);
}

bool SocketCan::Wait(std::int64_t deadline_ns) noexcept {
  for (;;) {
    const std::int64_t left_ns = deadline_ns - rt::MonotonicNowNs();
    if (left_ns <= 0) return false;
    if (impl_->Poll(left_ns <= kShortWaitNs ? 0 : left_ns) > 0) return true;
  }
}

std::uint64_t SocketCan::dropped() const noexcept {
  std::uint64_t dropped = 0;
  for (const auto& socket : impl_->sockets) dropped += socket->dropped();
  return dropped;
}

std::uint64_t SocketCan::clock_steps() const noexcept {
  std::uint64_t steps = 0;
  for (const auto& socket : impl_->sockets) steps = std::max(steps, socket->clock_steps());
  return steps;
}

}  // namespace levitas::socketcan
