// Cost of handing one record from the control loop to another thread, seen by the loop: post, and
// post into a full ring (the record is lost and counted).

#include <benchmark/benchmark.h>

#include <array>

#include "common/spsc_ring.hpp"

namespace levitas {
namespace {

// As large as what the loop records each cycle: about four lines of the cache.
using Record = std::array<double, 32>;

void PostAndTake(benchmark::State& state) {
  SpscRing<Record> ring(1024);
  Record record{};
  for (auto _ : state) {
    benchmark::DoNotOptimize(ring.Post(record));
    benchmark::DoNotOptimize(ring.Take(record));
  }
}
BENCHMARK(PostAndTake);

void PostIntoFullRing(benchmark::State& state) {
  SpscRing<Record> ring(16);
  const Record record{};
  while (ring.Post(record)) {
  }
  for (auto _ : state) benchmark::DoNotOptimize(ring.Post(record));
}
BENCHMARK(PostIntoFullRing);

}  // namespace
}  // namespace levitas
