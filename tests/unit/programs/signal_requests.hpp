#pragma once
// A rig with one channel that test signals are asked for on, and what is asked for.

#include "common/rig_numbers.hpp"
#include "configuration/rig_file.hpp"
#include "tests/support/paths.hpp"
#include "transport/operator_message.hpp"

namespace levitas::controller_program::test {

inline RigNumbers ShippedRig() {
  return configuration::LoadRig(levitas::test::SourceFolder() + "/config/rigs/flexible_rotor.yaml")
      .numbers;
}

inline transport::NetworkExcitation Request(std::int64_t sequence, const char* channel = "de_x") {
  transport::NetworkExcitation request;
  request.step_yaml = std::string("kind: excitation\nhold_s: 1\nexcitation:\n  - {channel: ") +
                      channel + ", signal: prbs, amplitude_a: 0.1, order: 7}\n";
  request.origin = {.sender = 1, .sequence = sequence};
  return request;
}

}  // namespace levitas::controller_program::test
