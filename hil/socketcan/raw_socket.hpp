#pragma once
// One raw CAN socket on one interface; what socket_can.hpp is made of. The contract is the same.

#include <linux/can.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hil/can/bus_access.hpp"
#include "hil/socketcan/stamp_clock.hpp"

namespace levitas::socketcan {

class RawSocket {
 public:
  /// Receives `ids` (11 bits) and error frames. Throws Problem.
  RawSocket(const std::string& interface, bool fd, const std::vector<std::uint32_t>& ids);
  ~RawSocket();
  RawSocket(const RawSocket&) = delete;
  RawSocket& operator=(const RawSocket&) = delete;

  /// Something that is there, or kNothing.
  [[nodiscard]] can::Reception Next() noexcept;
  [[nodiscard]] can::SendResult Send(const can::WireFrame& frame) noexcept;
  [[nodiscard]] int descriptor() const noexcept { return socket_; }
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }
  /// How often the wall clock was set.
  [[nodiscard]] std::uint64_t clock_steps() const noexcept { return clock_.steps(); }

 private:
  struct Batch;
  void Configure(const std::string& interface, bool fd, const std::vector<std::uint32_t>& ids);
  [[nodiscard]] can::Reception Translate(std::size_t at) noexcept;
  void ReadControl(std::size_t at, can::WireFrame& frame) noexcept;
  /// What the clock of time stamps shows now.
  void ReadClocks() noexcept;

  int socket_{-1};
  std::unique_ptr<Batch> batch_;  ///< frames of one system call
  StampClock clock_;
  std::uint64_t dropped_{0};
  std::uint32_t last_overflow_{0};
};

/// What an error frame of the kernel says.
[[nodiscard]] can::BusEvent EventOf(const canfd_frame& error) noexcept;

}  // namespace levitas::socketcan
