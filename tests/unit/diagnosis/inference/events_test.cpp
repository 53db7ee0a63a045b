// Lost frames, the level of the noise and mains, found in records made by hand.

#include "diagnosis/inference/events.hpp"
#include "analysis/reading_noise.hpp"
#include "diagnosis/inference/mains_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/effect_entry.hpp"
#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

Record NoisyRecord(std::uint64_t seed, std::size_t rows) {
  Random random(seed);
  Record record;
  record.rows.resize(rows);
  for (std::size_t n = 0; n < rows; ++n) {
    auto& row = record.rows[n];
    row.cycle = n;
    row.levitated = true;
    for (std::size_t a = 0; a < TheRig().axes; ++a) {
      row.sample.position_m[a] = kNoise * random.Normal();
      row.sample.command.control_current_a[a] = 0.1 * random.Normal();
    }
  }
  return record;
}

/// A residual whose noise is `factor` times the rig file's on the given axis.
Residual WithNoise(double factor, std::size_t axis = 0) {
  Residual residual;
  for (std::size_t a = 0; a < TheRig().axes; ++a) {
    ChannelResidual channel;
    channel.noise_rms_m =
        (a == axis ? factor : 1.0) * analysis::ReadingNoise(TheRig().bearing(a).sensor);
    residual.channels.push_back(channel);
  }
  return residual;
}

double Score(const std::vector<Candidate>& found, effect::Id effect) {
  for (const Candidate& candidate : found) {
    if (candidate.effect == effect) return candidate.score;
  }
  return 0.0;
}

TEST(EventsTest, AHealthyRecordHasNone) {
  EXPECT_TRUE(FindEvents(TheRig(), {NoisyRecord(1, 5000)}, WithNoise(1.0)).empty());
}

TEST(EventsTest, APauseBetweenTwoFlightsIsNoLostFrame) {
  Record record = NoisyRecord(2, 5000);
  record.rows.erase(record.rows.begin() + 2000, record.rows.begin() + 3000);
  EXPECT_TRUE(FindEvents(TheRig(), {record}, WithNoise(1.0)).empty());
}

TEST(EventsTest, MissingCyclesAreLostFrames) {
  Record record = NoisyRecord(2, 5000);
  for (const int at : {400, 1400, 2400}) record.rows.erase(record.rows.begin() + at);
  const auto found = FindEvents(TheRig(), {record}, WithNoise(1.0));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].effect, effect::Id::kDroppedSamples);
  EXPECT_EQ(found[0].place, "3 frames");
  EXPECT_GT(found[0].score, kDecisive);
}

TEST(EventsTest, AReadingThatRepeatsOnAllAxesIsALostFrameAndOnOneIsChance) {
  Record record = NoisyRecord(3, 5000);
  record.rows[700].sample.position_m = record.rows[699].sample.position_m;
  record.rows[900].sample.position_m = record.rows[899].sample.position_m;
  EXPECT_GT(Score(FindEvents(TheRig(), {record}, WithNoise(1.0)), effect::Id::kDroppedSamples),
            kDecisive);
  Record one = NoisyRecord(3, 5000);
  one.rows[700].sample.position_m[2] = one.rows[699].sample.position_m[2];
  EXPECT_TRUE(FindEvents(TheRig(), {one}, WithNoise(1.0)).empty());
}

TEST(EventsTest, FramesLostWhileTheRotorLiesDoNotCount) {
  Record record = NoisyRecord(4, 5000);
  for (auto& row : record.rows) row.levitated = row.cycle > 1000;
  record.rows.erase(record.rows.begin() + 300, record.rows.begin() + 310);
  EXPECT_TRUE(FindEvents(TheRig(), {record}, WithNoise(1.0)).empty());
}

TEST(EventsTest, ANoiseBeyondItsToleranceIsNamedWithItsChannel) {
  const auto found = FindEvents(TheRig(), {NoisyRecord(5, 5000)}, WithNoise(1.5, 2));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].effect, effect::Id::kSensorNoise);
  EXPECT_EQ(found[0].place, "nde_x");
  // A sixteenth more is within what a healthy rig shows.
  EXPECT_TRUE(FindEvents(TheRig(), {NoisyRecord(5, 5000)}, WithNoise(1.06, 2)).empty());
}

/// The rig of TheRig() whose file holds an effect besides.
RigView Holding(effect::Id id, std::initializer_list<double> values) {
  plant::PlantConfig plant = TheRig().model->config();
  plant.effects.push_back(test::Entry(id, values));
  return {TheRig().numbers, plant};
}

TEST(EventsTest, WhatTheRigFileKnowsToBeLostOrNoisyIsNoCause) {
  Record record = NoisyRecord(7, 5000);
  for (int k = 0; k < 50; ++k) record.rows.erase(record.rows.begin() + 90 * (50 - k));
  EXPECT_GT(Score(FindEvents(TheRig(), {record}, WithNoise(1.0)), effect::Id::kDroppedSamples),
            kDecisive);
  const RigView losing = Holding(effect::Id::kDroppedSamples, {0.01, 1.0});
  EXPECT_TRUE(FindEvents(losing, {record}, WithNoise(1.0)).empty());
  const RigView rarely = Holding(effect::Id::kDroppedSamples, {0.002, 1.0});
  EXPECT_GT(Score(FindEvents(rarely, {record}, WithNoise(1.0)), effect::Id::kDroppedSamples),
            kDecisive);

  const Record healthy = NoisyRecord(8, 5000);
  const RigView noisy = Holding(effect::Id::kSensorNoise, {1.5 * kNoise, 0.0});
  EXPECT_GT(Score(FindEvents(noisy, {healthy}, WithNoise(1.0)), effect::Id::kSensorNoise),
            kDecisive);
  Residual residual = WithNoise(1.0);
  for (auto& channel : residual.channels) channel.noise_rms_m = 1.5 * kNoise;
  EXPECT_TRUE(FindEvents(noisy, {healthy}, residual).empty());
}

TEST(MainsLinesTest, OfTheRigFileAreThereWithoutStandingOut) {
  const RigView humming = Holding(effect::Id::kMainsPickup, {150.0, 1e-6});
  EXPECT_EQ(MainsLines(humming, {NoisyRecord(6, 20'000)}), std::vector<double>{150.0});
}

TEST(MainsLinesTest, AreThoseThatStandOutOfTheirNeighbourhood) {
  Record record = NoisyRecord(6, 20'000);
  EXPECT_TRUE(MainsLines(TheRig(), {record}).empty());
  for (auto& row : record.rows) {
    row.sample.position_m[1] +=
        Sine(0.3e-6, 100.0, static_cast<double>(row.cycle) * TheRig().period_s);
  }
  EXPECT_EQ(MainsLines(TheRig(), {record}), std::vector<double>{100.0});
}

}  // namespace
}  // namespace levitas::diagnosis
