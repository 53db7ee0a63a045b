// A log of candump becomes a session, or is refused in one sentence. Checksums of the bus are those
// of the seeds: most mutations are counted as damaged.

#include <fmt/core.h>

#include "common/problem.hpp"
#include "hil/can/codec.hpp"
#include "session/exchange/candump_import.hpp"
#include "tests/fuzz/import_rig.hpp"

namespace levitas::fuzz {
namespace {

const can::Layout& Layout() {
  static const can::Layout kLayout = can::MakeLayout(ImportInto("").rig, can::Format::kFd);
  return kLayout;
}

std::string Line(const can::WireFrame& frame, double time_s) {
  std::string text =
      fmt::format("({:.6f}) can0 {:03X}{}", time_s, frame.id, frame.fd ? "##1" : "#");
  for (const std::uint8_t byte : frame.payload()) text += fmt::format("{:02X}", byte);
  return text + "\n";
}

}  // namespace

std::vector<std::string> Seeds() {
  std::string log;
  for (const can::Message& message : Layout().messages) {
    can::MessageCodec codec(message, can::Format::kFd);
    for (std::uint64_t cycle = 0; cycle < 3; ++cycle) {
      SensorFrame frame;
      frame.cycle = cycle;
      frame.axes = 4;
      log += Line(codec.Encode(can::ValuesOf(frame)), 1.0 + 1e-4 * static_cast<double>(cycle));
    }
  }
  return {log, "(1.000000) can0 123#0011\n(1.1) can0 20000080#0000000000000000\n"};
}

}  // namespace levitas::fuzz

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace levitas;
  try {
    const auto options = fuzz::ImportInto(fuzz::AsFile("data.log", {data, size}));
    (void)session::ImportCandump(options, fuzz::Layout());
  } catch (const BadInput&) {
    return 0;
  }
  return 0;
}
