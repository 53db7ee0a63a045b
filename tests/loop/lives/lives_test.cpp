#include <gtest/gtest.h>

#include "benchmark/lives/campaign.hpp"

namespace levitas::lives {
namespace {

TEST(Lives, OfOneSeedAreTheSameWhateverRanBefore) {
  const LifeRig rig = LoadLifeRig("flexible_rotor", "flexible_rotor_commissioned");
  const LifePlan plan = DrawLife(30, 3.0, rig.config.rig);
  const LifeResult once = RunLife(rig, plan);
  (void)RunLife(rig, DrawLife(31, 2.0, rig.config.rig));
  const LifeResult again = RunLife(rig, plan);
  EXPECT_EQ(Row(once), Row(again));
  EXPECT_EQ(once.highest_rpm, again.highest_rpm);
  EXPECT_GT(once.highest_rpm, 100.0);
}

}  // namespace
}  // namespace levitas::lives
