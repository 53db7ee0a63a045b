// Drawn lives as pairs: the harm without a protection, none with it. The seeds were found by
// searching the first lives of each kind; `amb bench lives --first SEED --seeds 1` tells their
// story.

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "benchmark/lives/campaign.hpp"

namespace levitas::lives {
namespace {

struct Pair {
  const char* name;
  std::uint64_t seed;
  std::function<void(supervisor::ProtectionConfig&)> weaken;
};

class DrawnPair : public testing::TestWithParam<Pair> {};

TEST_P(DrawnPair, TouchesUnderCurrentWithoutItsProtectionsOnly) {
  const LifeRig rig = LoadLifeRig("flexible_rotor", "flexible_rotor_commissioned");
  const LifePlan plan = DrawLife(GetParam().seed, 5.0, rig.config.rig);
  LifeRig weak = rig;
  GetParam().weaken(weak.config.supervisor.protection);
  const LifeResult without = RunLife(weak, plan);
  ASSERT_EQ(without.harms.size(), 1U);
  EXPECT_EQ(without.harms[0].harm, Harm::kTouchedUnderCurrent);
  EXPECT_GT(without.harms[0].speed_rpm, 1000.0);
  const LifeResult with = RunLife(rig, plan);
  EXPECT_TRUE(with.harms.empty()) << Row(with);
}

constexpr std::uint32_t kNeverCycles = 100'000;

void IgnoreMotion(supervisor::ProtectionConfig& protection) {
  protection.currents_late_cycles = kNeverCycles;
  protection.orbit_fraction = 100.0;
  protection.coil_saturated_s = 100.0;
}

INSTANTIATE_TEST_SUITE_P(Seeds, DrawnPair,
                         testing::Values(Pair{"frames_lost", 183,
                                              [](supervisor::ProtectionConfig& protection) {
                                                IgnoreMotion(protection);
                                                protection.frames_lost_cycles = kNeverCycles;
                                                protection.frame_missing_cycles = kNeverCycles;
                                              }},
                                         Pair{"currents_lost_in_bursts", 82, IgnoreMotion},
                                         Pair{"sensor_stuck", 119,
                                              [](supervisor::ProtectionConfig& protection) {
                                                protection.sensor_frozen_cycles = kNeverCycles;
                                              }}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// Lives in which the rotor once touched or was let go: older currents among new ones, test
// currents together with shifts.
class MendedLife : public testing::TestWithParam<std::uint64_t> {};

TEST_P(MendedLife, HasNoHarm) {
  const LifeRig rig = LoadLifeRig("flexible_rotor", "flexible_rotor_commissioned");
  const LifeResult life = RunLife(rig, DrawLife(GetParam(), 10.0, rig.config.rig));
  EXPECT_TRUE(life.harms.empty()) << Row(life);
  EXPECT_GT(life.highest_rpm, 1000.0);
}

// What docs/safety.md bears in a levitated stop is counted, not overlooked: a controller that
// stands still for 3 ms, jitter of the line.
TEST(DocumentedContact, IsCountedApartFromTheHarms) {
  const LifeRig rig = LoadLifeRig("flexible_rotor", "flexible_rotor_commissioned");
  for (const std::uint64_t seed : {276U, 371U}) {
    const LifeResult life = RunLife(rig, DrawLife(seed, 10.0, rig.config.rig));
    EXPECT_TRUE(life.harms.empty()) << Row(life);
    EXPECT_GT(life.documented_contacts, 0U) << seed;
    EXPECT_EQ(life.fault, Fault::kCurrentsLate);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, MendedLife, testing::Values(243, 10293));

}  // namespace
}  // namespace levitas::lives
