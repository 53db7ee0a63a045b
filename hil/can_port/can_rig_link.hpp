#pragma once
// The rig's end of the CAN buses: position messages out, current messages in. The contract is that
// of common/rig_link.hpp; what is bounded and ignored is as in can_rig_port.hpp.

#include <string>
#include <vector>

#include "common/rig_link.hpp"
#include "hil/can/assemblers.hpp"
#include "hil/can/bus_access.hpp"
#include "hil/can_port/bus_watch.hpp"

namespace levitas::can_port {

class CanRigLink final : public port::RigLink {
 public:
  /// Keeps a reference to `access`.
  CanRigLink(const can::Layout& layout, const std::vector<can::BusConfig>& buses,
             can::BusAccess& access);

  bool Send(const SensorFrame& frame) noexcept override;
  ReceiveResult Receive(CurrentFrame& frame, std::int64_t deadline_ns) noexcept override;
  [[nodiscard]] Counters counters() const noexcept override;
  [[nodiscard]] std::string Trouble() const override;

 private:
  struct Outgoing {
    can::MessageCodec codec;
    std::size_t bus{};
    std::uint32_t every{};
  };
  [[nodiscard]] ReceiveResult Accept(const can::Reception& reception, CurrentFrame& frame) noexcept;

  can::BusAccess& access_;
  can::CommandAssembler assembler_;
  std::vector<Outgoing> outgoing_;
  std::uint64_t own_cycle_{0};
  BusWatch watch_;
  Counters counters_;
};

}  // namespace levitas::can_port
