#pragma once
// Two ends of a bus in one thread: what one sends, the other receives; a test may put anything in
// between.

#include <deque>
#include <vector>

#include "hil/can/bus_access.hpp"
#include "tests/unit/can/rigs.hpp"

namespace levitas::can_port {

class FakeBus final : public can::BusAccess {
 public:
  can::Reception Next() noexcept override {
    if (arrived.empty()) return {};
    const can::Reception reception = arrived.front();
    arrived.pop_front();
    return reception;
  }
  can::SendResult Send(std::size_t bus, const can::WireFrame& frame) noexcept override {
    if (result != can::SendResult::kSent) return result;
    sent.push_back(frame);
    sent_bus.push_back(bus);
    if (other != nullptr) other->arrived.push_back({can::BusEvent::kFrame, bus, frame});
    return result;
  }
  bool Wait(std::int64_t /*deadline_ns*/) noexcept override {
    ++waits;
    return !arrived.empty();
  }
  [[nodiscard]] std::uint64_t dropped() const noexcept override { return 0; }

  void Event(can::BusEvent event, std::size_t socket = 0) {
    arrived.push_back({event, socket, {}});
  }

  std::deque<can::Reception> arrived;
  std::vector<can::WireFrame> sent;
  std::vector<std::size_t> sent_bus;
  FakeBus* other{nullptr};
  can::SendResult result{can::SendResult::kSent};
  int waits{0};
};

inline std::vector<can::BusConfig> TwoBuses() {
  return {{"positions", "can0", {1e6, 5e6}, can::Carries::kFromRig, 0.8},
          {"currents", "can1", {1e6, 5e6}, can::Carries::kToRig, 0.8}};
}

}  // namespace levitas::can_port
