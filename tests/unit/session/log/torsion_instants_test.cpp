#include "session/log/torsion_instants.hpp"

#include <gtest/gtest.h>

namespace levitas::session {
namespace {

/// The torque of sample s and coupling c is 100 s + c, the twist a thousand more.
TorsionBatch NumberedBatch(std::uint64_t first_cycle, std::uint32_t couplings,
                           std::uint32_t samples) {
  TorsionBatch batch;
  batch.first_cycle = first_cycle;
  batch.rig_session = 7;
  batch.couplings = couplings;
  batch.samples = samples;
  for (std::size_t s = 0; s < samples; ++s) {
    for (std::size_t c = 0; c < couplings; ++c) {
      const double number = 100.0 * static_cast<double>(s) + static_cast<double>(c);
      batch.torque_n_m[s * couplings + c] = number;
      batch.twist_rad[s * couplings + c] = number + 1000.0;
    }
  }
  return batch;
}

TEST(TorsionInstants, AreTheSamplesOfEveryBatchWithTheirOwnCycleAndCouplings) {
  const std::vector<TorsionBatch> batches{NumberedBatch(40, 3, 2), NumberedBatch(90, 3, 1)};
  std::vector<std::uint64_t> cycles;
  std::vector<double> third_torque_n_m;
  ForEachInstant(
      batches, 3,
      [&](std::uint32_t rig_session, std::uint64_t cycle, auto torque_n_m, auto twist_rad) {
        EXPECT_EQ(rig_session, 7U);
        ASSERT_EQ(torque_n_m.size(), 3U);
        ASSERT_EQ(twist_rad.size(), 3U);
        cycles.push_back(cycle);
        third_torque_n_m.push_back(torque_n_m[2]);
        EXPECT_EQ(twist_rad[1], torque_n_m[1] + 1000.0);
      });
  EXPECT_EQ(cycles, (std::vector<std::uint64_t>{40, 41, 90}));
  EXPECT_EQ(third_torque_n_m, (std::vector<double>{2.0, 102.0, 2.0}));
}

TEST(TorsionInstants, OfAFullBatchReachToItsLastValue) {
  const auto couplings = static_cast<std::uint32_t>(kMaxCouplings);
  const auto samples = static_cast<std::uint32_t>(kTorsionSamples);
  std::size_t visited = 0;
  double last_twist_rad = 0.0;
  ForEachInstant({NumberedBatch(0, couplings, samples)}, kMaxCouplings,
                 [&](std::uint32_t, std::uint64_t, auto, auto twist_rad) {
                   ++visited;
                   last_twist_rad = twist_rad.back();
                 });
  EXPECT_EQ(visited, kTorsionSamples);
  EXPECT_EQ(last_twist_rad, 1000.0 + 100.0 * (samples - 1.0) + (couplings - 1.0));
}

TEST(TorsionInstants, LeaveOutABatchOfAnotherRig) {
  std::vector<std::uint64_t> cycles;
  ForEachInstant({NumberedBatch(0, 2, 3), NumberedBatch(10, 1, 2), NumberedBatch(20, 3, 1)}, 1,
                 [&](std::uint32_t, std::uint64_t cycle, auto, auto) { cycles.push_back(cycle); });
  EXPECT_EQ(cycles, (std::vector<std::uint64_t>{10, 11}));
}

}  // namespace
}  // namespace levitas::session
