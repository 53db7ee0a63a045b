#pragma once
// The state of the buses as their events tell it, and how often each happened.
//
// Bus off  holds until the chip is back: meanwhile nothing from that bus is believed and nothing is
//          sent, so that the loop trips on missing frames and the rig's watchdog on missing
//          currents, whatever the wire still shows.
// Back     the chip has restarted, is error active, or was taken down, which makes it start anew.
//          Where a driver says none of this, kBackAfter frames that keep coming do: a chip that is
//          off receives none, and what had come before is fewer.
// Thread   one; no allocation.

#include <array>
#include <cstdint>
#include <string>

#include "hil/can/bus_access.hpp"

namespace levitas::can_port {

struct BusCounters {
  std::uint64_t bus_off{};
  std::uint64_t restarts{};
  std::uint64_t returns{};  ///< buses that were back without the chip's saying so
  std::uint64_t error_passive{};
  std::uint64_t protocol_errors{};
  std::uint64_t chip_overruns{};
  std::uint64_t link_down{};
  std::uint64_t unheard{};     ///< frames that came from a bus that is off
  std::uint64_t read_limit{};  ///< reads that ended with more frames waiting: a babbling node
  std::uint64_t stale{};       ///< real time: frames that had waited too long to be used
  std::uint64_t full{};        ///< ENOBUFS
  std::uint64_t down{};        ///< sends without a link
};

class BusWatch {
 public:
  static constexpr std::size_t kMaxSockets = 8;
  /// Ten times the periods without a frame after which the shipped protections trip.
  static constexpr std::uint32_t kBackAfter = 100;

  void Note(const can::Reception& reception) noexcept;
  void Note(can::SendResult result) noexcept;
  /// Whether a frame that came from this bus is to be believed.
  [[nodiscard]] bool Hears(std::size_t socket) noexcept;
  [[nodiscard]] bool Off(std::size_t socket) const noexcept { return off_[socket]; }
  [[nodiscard]] bool AnyOff() const noexcept;
  [[nodiscard]] BusCounters& counters() noexcept { return counters_; }
  [[nodiscard]] const BusCounters& counters() const noexcept { return counters_; }

 private:
  void Back(std::size_t socket) noexcept {
    off_[socket] = false;
    unheard_[socket] = 0;
  }

  std::array<bool, kMaxSockets> off_{};
  std::array<std::uint32_t, kMaxSockets> unheard_{};  ///< frames since it went off
  BusCounters counters_;
};

/// "2 x bus off, 1 x restarted ..."; empty when all are zero.
[[nodiscard]] std::string Text(const BusCounters& counters, std::uint64_t dropped);

}  // namespace levitas::can_port
