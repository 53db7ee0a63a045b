#pragma once
// The log that candump would write of the CAN bus of a recorded run.

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "controller/cycle/cycle_io.hpp"
#include "hil/can/codec.hpp"

namespace levitas::session::testing {

/// The lines of candump of a run: positions and the currents that answer them.
inline std::string BusLog(const std::vector<cycle::CycleRecord>& records,
                          const can::Layout& layout) {
  const auto line = [](const can::WireFrame& frame) {
    std::string text = fmt::format("(1.0) can0 {:03X}{}", frame.id, frame.fd ? "##1" : "#");
    for (const std::uint8_t byte : frame.payload()) text += fmt::format("{:02X}", byte);
    return text + "\n";
  };
  const auto codec_of = [&layout](std::uint32_t id) {
    const auto message = std::find_if(layout.messages.begin(), layout.messages.end(),
                                      [id](const can::Message& one) { return one.id == id; });
    return can::MessageCodec(*message, layout.format);
  };
  can::MessageCodec positions = codec_of(can::kPositionsId);
  can::MessageCodec currents = codec_of(can::kCurrentsId);
  std::string log;
  for (const auto& record : records) {
    if (!record.in.frame_present) continue;
    log += line(positions.Encode(can::ValuesOf(record.in.frame)));
    log += line(currents.Encode(can::ValuesOf(record.out.current, false)));
  }
  return log;
}

}  // namespace levitas::session::testing
