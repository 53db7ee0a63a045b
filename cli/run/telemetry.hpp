#pragma once
// Follows the controller's decimated telemetry (channel LEVITAS_STATE).
//
// Thread   one.
// Failure  Problem (exit status 1) when this machine cannot receive LCM multicast.
// Lost     telemetry may drop messages; nothing here depends on a single one.

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "cli/run/progress.hpp"
#include "transport/multicast_socket.hpp"

namespace levitas::cli {

/// What a datagram says of the run; nothing when it is not a sound state of the controller.
[[nodiscard]] std::optional<ProgressSample> StateIn(std::span<const std::uint8_t> datagram);

class Telemetry {
 public:
  explicit Telemetry(const transport::LcmNetwork& network);

  /// The newest state, waiting for at most `limit`; nothing when none came.
  [[nodiscard]] std::optional<ProgressSample> Wait(std::chrono::milliseconds limit);

 private:
  transport::MulticastReceiver receiver_;
};

}  // namespace levitas::cli
