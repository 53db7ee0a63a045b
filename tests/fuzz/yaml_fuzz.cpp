// A YAML text as a rig, a controller, a scenario and a test signal of the network. The first byte
// chooses which.

#include "common/problem.hpp"
#include "configuration/excitation_request.hpp"
#include "configuration/rig_file.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace levitas::fuzz {
namespace {

const RigNumbers& Rig() {
  static const RigNumbers kRig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs")).numbers;
  return kRig;
}

void Parse(std::uint8_t kind, const std::string& text) {
  constexpr const char* kName = "input.yaml";
  switch (kind % 4) {
    case 0:
      (void)configuration::WriteRig(configuration::ParseRig(text, kName));
      return;
    case 1:
      (void)configuration::WriteController(configuration::ParseController(text, kName, Rig()),
                                           Rig());
      return;
    case 2:
      (void)configuration::WriteScenario(configuration::ParseScenario(text, kName, Rig()));
      return;
    default:
      (void)configuration::ParseExcitation(text, kName, Rig());
  }
}

}  // namespace

std::vector<std::string> Seeds() {
  const auto shipped = [](char kind, const char* name, const char* folder) {
    return kind + Content(configuration::FindConfig(name, folder));
  };
  return {shipped('\0', "flexible_rotor", "rigs"), shipped('\1', "flexible_rotor", "controllers"),
          shipped('\2', "default", "scenarios"), shipped('\2', "identify", "scenarios"),
          "\3kind: excitation\nhold_s: 5\nexcitation:\n"
          "  - {channel: de_x, signal: chirp, amplitude_a: 0.2, from_hz: 10, to_hz: 400, "
          "repeat_s: 2}\n"};
}

}  // namespace levitas::fuzz

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return -1;
  try {
    levitas::fuzz::Parse(data[0], levitas::fuzz::AsText({data + 1, size - 1}));
  } catch (const levitas::Problem&) {
    return 0;
  }
  return 0;
}
