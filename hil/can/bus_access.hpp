#pragma once
// The buses as the loop reaches them: a kernel's sockets, or a test's own. Events instead of
// errors.
//
// Thread    one; no allocation, no exception, and only Wait waits.
// Failure   an event: what a bus cannot do any more is said once and then reads as silence.

#include <cstdint>

#include "hil/can/wire_frame.hpp"

namespace levitas::can {

enum class BusEvent : std::uint8_t {
  kNothing,        ///< no more is there
  kFrame,          ///< a data frame
  kBusOff,         ///< the controller chip has left the bus
  kRestarted,      ///< ... and is back
  kErrorActive,    ///< it takes part again without restrictions, so it is not off
  kErrorPassive,   ///< it may only listen to errors; the wiring or a node is bad
  kProtocolError,  ///< a bit, form, stuff, checksum or acknowledge error on the wire
  kChipOverrun,    ///< the chip lost frames before the kernel saw them
  kLinkDown,       ///< the interface was taken down or away
};

struct Reception {
  BusEvent event{BusEvent::kNothing};
  std::size_t socket{};  ///< of BusAccess, where it happened
  WireFrame frame;
};

enum class SendResult : std::uint8_t {
  kSent,  ///< taken by the transport
  kFull,  ///< ENOBUFS: the bus does not carry it; a miss, never tried again in the same period
  kDown,  ///< no link
};

class BusAccess {
 public:
  virtual ~BusAccess() = default;
  /// The next thing that is already there.
  virtual Reception Next() noexcept = 0;
  /// `bus`: index of the rig's buses.
  virtual SendResult Send(std::size_t bus, const WireFrame& frame) noexcept = 0;
  /// Waits until something may be there (true) or CLOCK_MONOTONIC reaches `deadline_ns` (false).
  virtual bool Wait(std::int64_t deadline_ns) noexcept = 0;
  /// Frames the kernel dropped because this end read too slowly.
  [[nodiscard]] virtual std::uint64_t dropped() const noexcept = 0;
  /// How often the wall clock was set, of which the kernel's time stamps are.
  [[nodiscard]] virtual std::uint64_t clock_steps() const noexcept { return 0; }
};

}  // namespace levitas::can
