#include "plant_sim/events/effect_schedule.hpp"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace levitas::events {
namespace {

constexpr double kPeriod_s = 1e-3;

ScheduledRigEvent Change(const std::string& effect, double at_s, double strength,
                         double ramp_s = 0.0) {
  ScheduledRigEvent event;
  event.kind = RigEventKind::kEffect;
  event.effect = effect;
  event.at_s = at_s;
  event.strength = strength;
  event.ramp_s = ramp_s;
  return event;
}

std::map<std::size_t, double> At(EffectSchedule& schedule, std::uint64_t cycle) {
  std::map<std::size_t, double> set;
  schedule.Apply(cycle, [&](std::size_t index, double strength) { set[index] = strength; });
  return set;
}

TEST(EffectSchedule, ASuddenChangeIsMadeOnceInItsCycle) {
  EffectSchedule schedule({Change("breathing_crack", 0.010, 1.0)}, {"unbalance", "breathing_crack"},
                          {1.0, 0.0}, kPeriod_s);
  for (std::uint64_t cycle = 0; cycle < 20; ++cycle) {
    const auto set = At(schedule, cycle);
    if (cycle != 10) {
      EXPECT_TRUE(set.empty()) << cycle;
    } else {
      EXPECT_EQ(set, (std::map<std::size_t, double>{{1, 1.0}}));
    }
  }
}

TEST(EffectSchedule, ASlowDriftIsAStraightLineFromWhatWasToWhatIsAsked) {
  EffectSchedule schedule({Change("unbalance", 0.010, 1.0, 0.020)}, {"unbalance"}, {0.5},
                          kPeriod_s);
  EXPECT_TRUE(At(schedule, 9).empty());
  for (std::uint64_t cycle = 10; cycle <= 30; ++cycle) {
    EXPECT_NEAR(At(schedule, cycle)[0], 0.5 + 0.5 * (static_cast<double>(cycle) - 10.0) / 20.0,
                1e-15);
  }
  EXPECT_TRUE(At(schedule, 31).empty());
}

TEST(EffectSchedule, ALaterChangeStartsFromWhereTheEarlierOneLeftIt) {
  EffectSchedule schedule({Change("unbalance", 0.020, 0.0, 0.010), Change("unbalance", 0.005, 0.8)},
                          {"unbalance"}, {0.0}, kPeriod_s);
  for (std::uint64_t cycle = 0; cycle < 25; ++cycle) (void)At(schedule, cycle);
  EXPECT_NEAR(At(schedule, 25)[0], 0.4, 1e-15);  // half way down from 0.8
}

TEST(EffectSchedule, AnIdOfSeveralEntriesMeansAllOfThem) {
  EffectSchedule schedule({Change("mains_pickup", 0.0, 0.3)},
                          {"mains_pickup", "unbalance", "mains_pickup"}, {}, kPeriod_s);
  EXPECT_EQ(At(schedule, 0), (std::map<std::size_t, double>{{0, 0.3}, {2, 0.3}}));
}

TEST(EffectSchedule, RefusesAnEffectThatTheRigDoesNotHave) {
  EXPECT_THROW(EffectSchedule({Change("unbalance", 0.0, 1.0)}, {"shaft_bow"}, {}, kPeriod_s),
               std::invalid_argument);
  EXPECT_THROW(EffectSchedule({}, {}, {}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::events
