#include "cli/run/telemetry.hpp"

#include <levitas_msg/controller_state_t.hpp>

#include "lcmtypes/checked_decode.hpp"
#include "rt/clock.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::cli {

std::optional<ProgressSample> StateIn(std::span<const std::uint8_t> datagram) {
  const transport::Packet packet = transport::ParsePacket(datagram);
  if (packet.kind != transport::PacketKind::kShort ||
      packet.channel != transport::channel::kState) {
    return std::nullopt;
  }
  levitas_msg::controller_state_t state{};
  if (!message::DecodeChecked(packet.payload, state)) return std::nullopt;
  return ProgressSample{static_cast<std::uint64_t>(state.cycle), static_cast<Mode>(state.mode),
                        state.speed_rad_per_s, state.position_m};
}

Telemetry::Telemetry(const transport::LcmNetwork& network)
    : receiver_(network, transport::Direction::kTelemetry) {}

std::optional<ProgressSample> Telemetry::Wait(std::chrono::milliseconds limit) {
  const std::int64_t deadline_ns = rt::MonotonicNowNs() + std::chrono::nanoseconds(limit).count();
  std::optional<ProgressSample> newest;
  // Waits for the first state, then takes what is there already.
  for (;;) {
    const auto received = receiver_.Receive(newest ? 0 : deadline_ns);
    if (received.datagram.empty()) return newest;
    if (auto sample = StateIn(received.datagram)) newest = std::move(sample);
  }
}

}  // namespace levitas::cli
