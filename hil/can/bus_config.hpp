#pragma once
// The CAN buses of a rig as its file describes them. Plain data.

#include <cstdint>
#include <string>

#include "hil/can/frame_time.hpp"

namespace levitas::can {

/// Which of the layout's messages a bus carries.
enum class Carries : std::uint8_t {
  kEverything = 0,
  kFromRig = 1,  ///< what the rig sends
  kToRig = 2,    ///< what the controller sends
};

/// When the rig lets a current act whose frame is there.
enum class Acts : std::uint8_t {
  kAtNextSample = 0,  ///< at its next sampling instant
  kOnArrival = 1,     ///< at once
};

struct BusConfig {
  std::string name;
  std::string interface;  ///< of the kernel, "can0"; --port may name another
  BitRates rates;
  Carries carries{Carries::kEverything};
  double load_limit{0.8};                  ///< share of the time that the loop may occupy
  Acts current_acts{Acts::kAtNextSample};  ///< of the bus that carries the currents
};

}  // namespace levitas::can
