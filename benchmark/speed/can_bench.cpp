// Cost of the bus codec per cycle: positions and currents of four axes, both directions at one end
// (decode the rig's message, encode ours), checksum and order included.

#include <benchmark/benchmark.h>

#include "hil/can/assemblers.hpp"
#include "tests/unit/can/rigs.hpp"

namespace {

using namespace levitas;

void ControllerEnd(benchmark::State& state, can::Format format) {
  const can::Layout layout = can::MakeLayout(can::TestRig(4), format);
  std::vector<can::MessageCodec> rig;
  std::vector<can::MessageCodec> currents;
  for (const can::Message& message : layout.messages) {
    if (message.every > 1) continue;
    (message.sender == can::Sender::kRig ? rig : currents).emplace_back(message, format);
  }
  can::RigAssembler assembler(layout);
  Random random(1);
  // Encoded beforehand: the rig's own work is not ours.
  constexpr std::size_t kFrames = 4096 * 15;  // cycle and counter return together
  std::vector<can::WireFrame> wire;
  wire.reserve(kFrames * rig.size());
  for (std::size_t cycle = 0; cycle < kFrames; ++cycle) {
    SensorFrame frame = can::RandomSensorFrame(random, 4);
    frame.cycle = cycle;
    frame.rig_session = 1;
    for (can::MessageCodec& codec : rig) wire.push_back(codec.Encode(can::ValuesOf(frame)));
  }
  SensorFrame sensor;
  CurrentFrame current = can::RandomCurrentFrame(random, 4);
  std::size_t at = 0;
  for (auto _ : state) {
    for (std::size_t part = 0; part < rig.size(); ++part) {
      benchmark::DoNotOptimize(assembler.Take(wire[at], sensor));
      at = at + 1 == wire.size() ? 0 : at + 1;
    }
    current.cycle = sensor.cycle;
    const can::Values values = can::ValuesOf(current, false);
    for (can::MessageCodec& codec : currents) benchmark::DoNotOptimize(codec.Encode(values));
  }
}

void CanFd(benchmark::State& state) { ControllerEnd(state, can::Format::kFd); }
void CanClassical(benchmark::State& state) { ControllerEnd(state, can::Format::kClassical); }
BENCHMARK(CanFd);
BENCHMARK(CanClassical);

}  // namespace
