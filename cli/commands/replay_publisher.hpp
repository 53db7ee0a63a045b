#pragma once
// Publishes a session again over LCM, on the channels and ports of the live processes, at the
// recorded pace: what lcm-spy, lcm-logger and a dashboard saw, they see again.
//
// Channels  LEVITAS_SENSOR on the base port, LEVITAS_CURRENT on base + 1, LEVITAS_STATE (every 10
//           ms of the run) and LEVITAS_EVENT on base + 2.
// Gaps      where records are missing, at most kLongestWait is waited; the rest is left out and
//           counted.
// Caution   a controller or a rig that runs on the same ports would take the frames for live ones.
// Failure   Problem when the network cannot be reached.

#include <chrono>
#include <cstdint>
#include <string>

#include "session/log/session_reader.hpp"

namespace levitas::cli {

inline constexpr std::chrono::seconds kLongestWait{2};

struct PublishOptions {
  std::string port{"lcm"};  ///< as --port of the live programs
  std::string key;          ///< file with the key of those who may speak; empty: none
  double speed{1.0};        ///< of the recorded pace; 2 is twice as fast
};

struct PublishReport {
  std::uint64_t cycles{};
  std::uint64_t events{};
  std::uint64_t failed{};  ///< messages LCM could not take
  std::uint64_t gaps{};    ///< that were shortened
};

[[nodiscard]] PublishReport Publish(session::SessionReader& reader, const PublishOptions& options);

}  // namespace levitas::cli
