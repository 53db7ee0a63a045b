#pragma once
// One raw CAN socket on one interface; what socket_can.hpp is made of. The contract is the same.

#include <linux/can.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hil/can/bus_access.hpp"

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

 private:
  struct Batch;
  void Configure(const std::string& interface, bool fd, const std::vector<std::uint32_t>& ids);
  [[nodiscard]] can::Reception Translate(std::size_t at) noexcept;
  void ReadControl(std::size_t at, can::WireFrame& frame) noexcept;
  /// CLOCK_MONOTONIC less the clock of time stamps.
  void MeasureClocks() noexcept;

  int socket_{-1};
  std::unique_ptr<Batch> batch_;  ///< frames of one system call
  std::int64_t clock_offset_ns_{0};
  std::uint32_t batches_{0};
  std::uint64_t dropped_{0};
  std::uint32_t last_overflow_{0};
};

/// What an error frame of the kernel says.
[[nodiscard]] can::BusEvent EventOf(const canfd_frame& error) noexcept;

}  // namespace levitas::socketcan
