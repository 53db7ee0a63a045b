#include "transport/sample_batcher.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "transport/histogram_message.hpp"

namespace levitas::transport {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;

/// Decodes what comes out.
struct Sink {
  std::vector<levitas_msg::sample_batch_t> batches;
  SampleBatcher batcher{2, [this](std::vector<std::uint8_t> encoded) {
                          levitas_msg::sample_batch_t batch{};
                          ASSERT_GT(
                              batch.decode(encoded.data(), 0, static_cast<int>(encoded.size())), 0);
                          batches.push_back(batch);
                        }};
  cycle::CycleRecord record;
  void Cycle(std::uint64_t cycle, std::int64_t now_ns) {
    record.in.cycle = cycle;
    record.in.frame.position_m[1] = 1e-9 * static_cast<double>(cycle);
    record.in.frame.sample_time_ns = static_cast<std::int64_t>(cycle) * 7;
    batcher.Add(record, now_ns);
  }
  [[nodiscard]] std::uint64_t Passed() const {
    std::uint64_t cycles = 0;
    for (const auto& batch : batches) cycles += static_cast<std::uint64_t>(batch.samples);
    return cycles;
  }
};

TEST(SampleBatcher, PassesEveryCycleOfALoopOnTheClock) {
  Sink sink;
  constexpr std::uint64_t kCycles = 4 * 20'000;  // four seconds of the fastest loop, 20 kHz
  for (std::uint64_t cycle = 0; cycle < kCycles; ++cycle) {
    sink.Cycle(cycle, static_cast<std::int64_t>(cycle) * 50'000);
  }
  EXPECT_GE(sink.Passed() + SampleBatcher::kBatch, kCycles);  // the last batch may be open
  std::int64_t expected = 0;
  for (const auto& batch : sink.batches) {
    ASSERT_EQ(batch.first_cycle, expected);
    expected += batch.samples;
  }
}

TEST(SampleBatcher, IsBoundedByTheClockWhateverTheLoopDoes) {
  Sink sink;
  // Half a million cycles within one second: a lockstep run far faster than any machine's.
  for (std::uint64_t cycle = 0; cycle < 500'000; ++cycle) {
    sink.Cycle(cycle, static_cast<std::int64_t>(cycle) * 2000);
  }
  EXPECT_LE(sink.Passed(), static_cast<std::uint64_t>(SampleBatcher::kCyclesPerSecond +
                                                      SampleBatcher::kBucketCycles));
  EXPECT_GE(sink.Passed(), static_cast<std::uint64_t>(SampleBatcher::kCyclesPerSecond) / 2);
}

TEST(SampleBatcher, PassesWholeStretchesSoThatASpectrumFindsItsSamples) {
  Sink sink;
  for (std::uint64_t cycle = 0; cycle < 200'000; ++cycle) {
    sink.Cycle(cycle, static_cast<std::int64_t>(cycle) * 1000);
  }
  std::uint64_t piece = 0;
  std::int64_t next = -1;
  for (const auto& batch : sink.batches) {
    if (batch.first_cycle != next && next >= 0) {
      EXPECT_GE(piece, SampleBatcher::kStretch);
      piece = 0;
    }
    piece += static_cast<std::uint64_t>(batch.samples);
    next = batch.first_cycle + batch.samples;
  }
}

TEST(SampleBatcher, StartsANewBatchBehindAGap) {
  Sink sink;
  for (std::uint64_t cycle = 0; cycle < 10; ++cycle) sink.Cycle(cycle, 0);
  for (std::uint64_t cycle = 20; cycle < 20 + SampleBatcher::kBatch; ++cycle) sink.Cycle(cycle, 0);
  ASSERT_EQ(sink.batches.size(), 2U);
  EXPECT_EQ(sink.batches[0].samples, 10);
  EXPECT_EQ(sink.batches[0].last_time_ns, 9 * 7);
  EXPECT_EQ(sink.batches[1].first_cycle, 20);
  EXPECT_FLOAT_EQ(sink.batches[1].position_m.at(1), 20e-9F);
}

TEST(SampleBatcher, EarnsNoMoreThanABucketInAnyPause) {
  Sink sink;
  sink.Cycle(0, 0);
  for (std::uint64_t cycle = 1; cycle < 100'000; ++cycle) sink.Cycle(cycle, 3600 * kSecondNs);
  EXPECT_LE(sink.Passed(), static_cast<std::uint64_t>(2 * SampleBatcher::kBucketCycles));
}

TEST(HistogramMessage, KeepsEveryCountInItsBin) {
  Histogram wakeup;
  Histogram compute;
  Histogram latency;
  for (int i = 0; i < 5; ++i) compute.Add(1000);
  compute.Add(3'000'000);
  latency.Add(200);
  const auto message = HistogramMessage(77, wakeup, compute, latency);
  EXPECT_EQ(message.cycle, 77);
  ASSERT_EQ(message.edge_ns.size(), static_cast<std::size_t>(message.bins));
  std::int64_t below = 0;
  std::int64_t total = 0;
  for (std::size_t i = 0; i < message.edge_ns.size(); ++i) {
    if (1000 > below && 1000 <= message.edge_ns[i]) {
      EXPECT_EQ(message.compute[i], 5);
    }
    if (3'000'000 > below && 3'000'000 <= message.edge_ns[i]) {
      EXPECT_EQ(message.compute[i], 1);
    }
    below = message.edge_ns[i];
    total += message.wakeup[i] + message.compute[i] + message.latency[i];
  }
  EXPECT_EQ(total, 7);
  EXPECT_EQ(message.latency.front(), 1) << "unused bins before the first are left out";
  EXPECT_EQ(message.compute.back(), 1) << "and behind the last";
}

TEST(HistogramMessage, HasNoBinsWithoutCounts) {
  EXPECT_EQ(HistogramMessage(0, {}, {}, {}).bins, 0);
}

}  // namespace
}  // namespace levitas::transport
