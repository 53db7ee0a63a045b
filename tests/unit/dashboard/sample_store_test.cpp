#include "dashboard/sample_store.hpp"

#include <gtest/gtest.h>

#include "batches.hpp"

namespace levitas::dashboard {
namespace {

/// Cycle number times 1 nm on x, minus that on y.
double Ramp(std::int64_t cycle, int axis) {
  return static_cast<double>(cycle) * (axis == 0 ? 1e-9 : -1e-9);
}

TEST(SampleStore, GivesBackTheNewestSamplesInOrder) {
  SampleStore store(SmallRig());
  ASSERT_TRUE(store.Add(Batch(10, 5, Ramp)));
  EXPECT_EQ(store.newest_cycle(), 14U);
  EXPECT_FLOAT_EQ(store.Position(0, 0), 14e-9F);
  EXPECT_FLOAT_EQ(store.Position(1, 4), -10e-9F);
  EXPECT_FLOAT_EQ(store.Current(0, 1), 13e-6F);
}

TEST(SampleStore, UndoesPolarityOfProbesAndCoils) {
  RigNumbers rig = SmallRig();
  rig.sensor_polarity[0] = -1.0;
  rig.actuator_polarity[1] = -1.0;
  SampleStore store(rig);
  ASSERT_TRUE(store.Add(Batch(10, 1, Ramp)));
  EXPECT_FLOAT_EQ(store.Position(0, 0), -10e-9F);
  EXPECT_FLOAT_EQ(store.Position(1, 0), -10e-9F);
  EXPECT_FLOAT_EQ(store.Current(0, 0), 10e-6F);
  EXPECT_FLOAT_EQ(store.Current(1, 0), 10e-6F);
}

TEST(SampleStore, AGuidedAxisIsABearingThatDoesNotMoveAlongY) {
  RigNumbers rig = SmallRig();
  rig.channels.resize(1);
  SampleStore store(rig);
  levitas_msg::sample_batch_t batch = Batch(10, 1, Ramp);
  batch.axes = 1;
  batch.position_m.resize(1);
  batch.control_current_a.resize(1);
  ASSERT_TRUE(store.Add(batch));
  ASSERT_EQ(store.bearings(), 1U);
  EXPECT_FLOAT_EQ(store.Displacement(0, 0, 0), 10e-9F);
  EXPECT_EQ(store.Displacement(0, 1, 0), 0.0F);
}

TEST(SampleStore, CountsAsContiguousOnlyWhatFollowsWithoutAGap) {
  SampleStore store(SmallRig());
  ASSERT_TRUE(store.Add(Batch(0, 100, Ramp)));
  ASSERT_TRUE(store.Add(Batch(100, 100, Ramp)));
  EXPECT_EQ(store.contiguous(), 200U);
  ASSERT_TRUE(store.Add(Batch(201, 100, Ramp)));
  EXPECT_EQ(store.contiguous(), 100U);
  ASSERT_TRUE(store.Add(Batch(0, 50, Ramp)));  // another run
  EXPECT_EQ(store.contiguous(), 50U);
}

TEST(SampleStore, NeverHoldsMoreThanItsCapacity) {
  SampleStore store(SmallRig());
  constexpr int kBatch = 4096;
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(store.Add(Batch(i * kBatch, kBatch, Ramp)));
  EXPECT_EQ(store.contiguous(), SampleStore::kCapacity);
  const auto back = SampleStore::kCapacity - 1;
  const double oldest = 20.0 * kBatch - 1.0 - static_cast<double>(back);
  EXPECT_FLOAT_EQ(store.Position(0, back), static_cast<float>(oldest * 1e-9));
}

TEST(SampleStore, KeepsTheAmplitudeOfAVibrationFasterThanTheBuckets) {
  SampleStore store(SmallRig());
  // +-3 um in turn, far faster than the 25 ms of a bucket (250 cycles).
  ASSERT_TRUE(store.Add(
      Batch(0, 600, [](std::int64_t cycle, int) { return cycle % 2 == 0 ? 3e-6 : -3e-6; })));
  const auto buckets = store.TakeEnvelopes();
  ASSERT_EQ(buckets.size(), 2U);
  for (const Envelope& bucket : buckets) {
    EXPECT_FLOAT_EQ(bucket.low_m.at(0), -3e-6F);
    EXPECT_FLOAT_EQ(bucket.high_m.at(0), 3e-6F);
  }
  EXPECT_DOUBLE_EQ(buckets[0].time_s, 249 * 1e-4);
  EXPECT_TRUE(store.TakeEnvelopes().empty()) << "taken once";
}

TEST(SampleStore, DropsTheOldestBucketsWhenNobodyTakesThem) {
  SampleStore store(SmallRig());
  constexpr int kBatch = 250;
  const int batches = static_cast<int>(SampleStore::kMaxEnvelopes) + 10;
  for (int i = 0; i < batches; ++i) ASSERT_TRUE(store.Add(Batch(i * kBatch, kBatch, Ramp)));
  const auto buckets = store.TakeEnvelopes();
  EXPECT_EQ(buckets.size(), SampleStore::kMaxEnvelopes);
  EXPECT_DOUBLE_EQ(buckets.back().time_s, (batches * kBatch - 1) * 1e-4);
}

TEST(SampleStore, RefusesBatchesThatDoNotFitTheRig) {
  const auto good = Batch(0, 4, Ramp);
  auto other_axes = good;
  other_axes.axes = 4;
  auto short_positions = good;
  short_positions.position_m.pop_back();
  auto no_samples = good;
  no_samples.samples = 0;
  auto negative = good;
  negative.samples = -4;
  auto before_time = good;
  before_time.first_cycle = -1;
  SampleStore store(SmallRig());
  for (const auto& bad : {other_axes, short_positions, no_samples, negative, before_time}) {
    EXPECT_FALSE(store.Add(bad));
  }
  EXPECT_EQ(store.count(), 0U);
}

}  // namespace
}  // namespace levitas::dashboard
