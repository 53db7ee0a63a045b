#include "identification/live/play_session.hpp"

#include <vector>

#include "transport/lcm_network.hpp"
#include "transport/sample_batcher.hpp"
#include "transport/state_cadence.hpp"

namespace levitas::identification {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

}  // namespace

void PlaySession(session::SessionReader& reader, LiveIdentification& live,
                 const std::function<bool()>& wanted) {
  const session::SessionHeader& header = reader.header();
  const std::uint64_t state_every = transport::CyclesPerState(header.period_ns);
  bool go_on = true;
  transport::SampleBatcher batcher(header.channels.size(), [&](std::vector<std::uint8_t> batch) {
    live.Take(transport::channel::kSamples, batch);
    go_on = !wanted || wanted();
  });
  // A clock so fast that the batcher never has to leave a stretch out.
  std::int64_t now_ns = 0;
  cycle::CycleRecord record;
  while (go_on && reader.Next(record)) {
    batcher.Add(record, now_ns += kNsPerSecond);
    if (record.in.cycle % state_every == 0) live.Take(record.in.cycle, record.out.mode);
  }
}

}  // namespace levitas::identification
