// Cost of a network's key: sealing and checking one datagram beside encoding the same frame.

#include <benchmark/benchmark.h>

#include <vector>

#include "transport/frame_codec.hpp"
#include "transport/seal.hpp"

namespace levitas::transport {
namespace {

constexpr std::size_t kAxes = 4;
constexpr std::int64_t kNow = 1'800'000'000'000'000'000;

SealingKey Key() { return NetworkKey(SealingKey::Bytes{1}, "").For("bench"); }

void SealAndCheck(benchmark::State& state) {
  SensorFrameCodec codec(kAxes);
  const auto frame = codec.Encode({});
  std::vector<std::uint8_t> buffer(frame.begin(), frame.end());
  buffer.resize(frame.size() + kTrailerBytes);
  Sealer sealer(Key());
  SealCheck check(Key(), SealRule::kClock, 0);
  std::int64_t now_ns = kNow;
  for (auto _ : state) {
    ++now_ns;
    auto datagram = sealer.Append(buffer, frame.size(), static_cast<std::uint64_t>(now_ns));
    if (check.Open(datagram, {now_ns, now_ns - kNow}) != SealWord::kGood)
      state.SkipWithError("refused");
  }
  state.counters["bytes"] = static_cast<double>(frame.size());
}
BENCHMARK(SealAndCheck);

void EncodeAlone(benchmark::State& state) {
  SensorFrameCodec codec(kAxes);
  SensorFrame frame;
  for (auto _ : state) {
    const auto datagram = codec.Encode(frame);
    benchmark::DoNotOptimize(datagram.data());
    ++frame.cycle;
  }
}
BENCHMARK(EncodeAlone);

}  // namespace
}  // namespace levitas::transport
