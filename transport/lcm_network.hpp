#pragma once
// Which multicast group and ports the processes meet on, from --port.
//
//   lcm                                        the default below
//   lcm:udpm://239.255.76.67:7667?ttl=0        explicit; base of four consecutive UDP ports
//
// One port per direction, because a process wakes for everything on a port it listens to, its own
// messages included.
//
// Failure  Problem (exit status 2) with the form that is allowed.

#include <cstdint>
#include <memory>
#include <string>

namespace levitas::transport {

/// Offset from the base port, by direction.
enum class Direction : std::uint16_t { kSensor = 0, kCurrent = 1, kTelemetry = 2, kCommand = 3 };

namespace channel {
inline constexpr const char* kSensor = "LEVITAS_SENSOR";    ///< rig -> controller, each period
inline constexpr const char* kTorsion = "LEVITAS_TORSION";  ///< rig -> controller, in batches
inline constexpr const char* kCurrent = "LEVITAS_CURRENT";  ///< controller -> rig, each period
/// controller -> rig: the last current frame (amplifiers off) of a controller that ends orderly.
inline constexpr const char* kGoodbye = "LEVITAS_GOODBYE";
inline constexpr const char* kState = "LEVITAS_STATE";
inline constexpr const char* kTiming = "LEVITAS_TIMING";
inline constexpr const char* kHistogram = "LEVITAS_HISTOGRAM";
inline constexpr const char* kEvent = "LEVITAS_EVENT";
inline constexpr const char* kAnswer = "LEVITAS_ANSWER";    ///< to one command, by number
inline constexpr const char* kSamples = "LEVITAS_SAMPLES";  ///< full rate, in batches
inline constexpr const char* kHeader = "LEVITAS_HEADER";    ///< what runs, once a second
/// online identification -> viewers, on the port of the telemetry
inline constexpr const char* kConvergence = "LEVITAS_CONVERGENCE";
inline constexpr const char* kCommand = "LEVITAS_COMMAND";        ///< operator -> controller
inline constexpr const char* kExcitation = "LEVITAS_EXCITATION";  ///< operator -> controller
inline constexpr const char* kHello = "LEVITAS_HELLO";            ///< asks for a challenge
inline constexpr const char* kChallenge = "LEVITAS_CHALLENGE";    ///< controller -> operators
}  // namespace channel

class NetworkKey;

struct LcmNetwork {
  std::string group{"239.255.76.67"};
  std::uint16_t base_port{7667};
  int ttl{0};  ///< 0: loopback interface only, see multicast_socket.hpp
  /// Who may speak: every datagram carries a seal of it (seal.hpp). Null: none is asked for.
  std::shared_ptr<const NetworkKey> key{};

  [[nodiscard]] bool this_machine_only() const noexcept { return ttl == 0; }

  [[nodiscard]] std::uint16_t Port(Direction direction) const noexcept {
    return static_cast<std::uint16_t>(base_port + static_cast<std::uint16_t>(direction));
  }
  /// The URL that LCM's own tools take for this direction.
  [[nodiscard]] std::string Url(Direction direction) const;
};

/// Reads "lcm" or "lcm:URL". `other_forms` ("can, ") are ports that the caller would take besides,
/// for the message on one that nobody takes.
[[nodiscard]] LcmNetwork ParseLcmNetwork(const std::string& text,
                                         const std::string& other_forms = {});

/// Gives the network the key of this file; an empty path: none. Without one, a network that other
/// machines reach is refused (exit status 2): `could` says what they could do there.
void TakeKey(LcmNetwork& network, const std::string& key_path, const char* could);

}  // namespace levitas::transport
