#pragma once
// CAN buses of the kernel: raw sockets, one for each interface.
//
// Filters     only the identifiers of the other end reach us, and error frames of the chip.
// Time        each frame carries the kernel's time stamp of its reception, turned to
//             CLOCK_MONOTONIC, whenever somebody sets the wall clock (stamp_clock.hpp).
// Bounded     Next never waits; Wait sleeps in ppoll, a short wait spins.
// Lost        the kernel's own count of frames that did not fit our buffer (SO_RXQ_OVFL).
// Thread      one; after construction no allocation, no exception.
// Failure     construction throws Problem (exit status 1) with the remedy: no interface, it is
//             down, no CAN FD, no CAN in the kernel. Later failures are events.

#include <memory>
#include <optional>

#include "hil/can/bus_access.hpp"
#include "hil/can/layout.hpp"

namespace levitas::socketcan {

class SocketCan final : public can::BusAccess {
 public:
  /// `own` is this end: what it sends is not received. None: a listener beside both ends.
  SocketCan(const can::Layout& layout, const std::vector<can::BusConfig>& buses,
            std::optional<can::Sender> own);
  ~SocketCan() override;
  SocketCan(const SocketCan&) = delete;
  SocketCan& operator=(const SocketCan&) = delete;

  can::Reception Next() noexcept override;
  can::SendResult Send(std::size_t bus, const can::WireFrame& frame) noexcept override;
  bool Wait(std::int64_t deadline_ns) noexcept override;
  [[nodiscard]] std::uint64_t dropped() const noexcept override;
  [[nodiscard]] std::uint64_t clock_steps() const noexcept override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::socketcan
