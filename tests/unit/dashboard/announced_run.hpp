#pragma once
// Telemetry of the shipped rig as a dashboard hears it.

#include <vector>

#include "configuration/rig_file.hpp"
#include "dashboard/live_run.hpp"
#include "session/log/record_codec.hpp"
#include "transport/lcm_network.hpp"

namespace levitas::dashboard {

inline session::Bytes EncodedHeader(std::int64_t start_utc_ns,
                                    const std::string& rig = "flexible_rotor") {
  session::SessionHeader header;
  header.rig_yaml =
      configuration::WriteRig(configuration::LoadRig(configuration::FindConfig(rig, "rigs")));
  header.pace = "lockstep";
  header.source = "lcm";
  header.start_utc_ns = start_utc_ns;
  session::Bytes bytes;
  session::EncodeHeader(header, bytes);
  return bytes;
}

/// The same rig with its commissioned law, one block of synchronous control, and a bias that falls.
inline session::Bytes HeaderWithBlock(std::int64_t start_utc_ns, const std::string& block_name) {
  const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  configuration::ControllerFile controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers);
  synchronous::BlockConfig& block = controller.synchronous.blocks.emplace_back();
  block.name = block_name;
  block.from_rad_per_s = 200.0;
  block.to_rad_per_s = 400.0;
  block.hysteresis_rad_per_s = 3.0;
  block.inverse.resize(1);
  block.inverse[0].speed_rad_per_s = 200.0;
  block.inverse[0].inverse.real[0][0] = 1.0;
  controller.bias.lowest_current_a = 0.3;
  session::SessionHeader header;
  header.rig_yaml = configuration::WriteRig(rig);
  header.controller_yaml = configuration::WriteController(controller, rig.numbers);
  header.start_utc_ns = start_utc_ns;
  session::Bytes bytes;
  session::EncodeHeader(header, bytes);
  return bytes;
}

inline session::Bytes EncodedEvent(const std::string& text) {
  session::Event event;
  event.text = text;
  session::Bytes bytes;
  session::EncodeEvent(event, bytes);
  return bytes;
}

template <class Message>
std::vector<std::uint8_t> Encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// A rotor at 3000 rpm that has just tripped, 4 axes.
inline levitas_msg::controller_state_t TrippedState() {
  levitas_msg::controller_state_t state{};
  state.cycle = 5000;
  state.mode = static_cast<std::int8_t>(Mode::kTripped);
  state.fault = static_cast<std::int8_t>(Fault::kOverSpeed);
  state.fault_axis = -1;
  state.speed_rad_per_s = 100.0 * 3.14159265358979323846;
  return state;
}

}  // namespace levitas::dashboard
