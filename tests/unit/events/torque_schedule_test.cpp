#include "plant_sim/events/torque_schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace levitas::events {
namespace {

constexpr double kTorquePeriod_s = 1e-3;
const std::vector<std::string> kInertias{"motor", "gear", "brake"};

ScheduledRigEvent Torque(const std::string& inertia, double at_s, double torque_n_m,
                         double duration_s = 0.0, double ramp_s = 0.0) {
  ScheduledRigEvent event;
  event.kind = RigEventKind::kTorque;
  event.inertia = inertia;
  event.at_s = at_s;
  event.torque_n_m = torque_n_m;
  event.duration_s = duration_s;
  event.ramp_s = ramp_s;
  return event;
}

/// What acts in each of `cycles`, and how often it was set.
std::vector<std::map<std::size_t, double>> Played(const std::vector<ScheduledRigEvent>& events,
                                                  std::size_t cycles, int& calls) {
  TorqueSchedule schedule(events, kInertias, kTorquePeriod_s);
  std::vector<std::map<std::size_t, double>> played(cycles);
  std::map<std::size_t, double> now;
  for (std::size_t n = 0; n < cycles; ++n) {
    schedule.Apply(n, [&](std::size_t index, double torque_n_m) {
      now[index] = torque_n_m;
      ++calls;
    });
    played[n] = now;
  }
  return played;
}

TEST(TorqueSchedule, AStepStaysAndAnImpactGoes) {
  int calls = 0;
  const auto played =
      Played({Torque("brake", 0.005, 3.0), Torque("motor", 0.010, -2.0, 0.004)}, 30, calls);
  for (std::size_t n = 0; n < played.size(); ++n) {
    const auto of = [&](std::size_t index) {
      const auto found = played[n].find(index);
      return found == played[n].end() ? 0.0 : found->second;
    };
    EXPECT_EQ(of(2), n >= 5 ? 3.0 : 0.0) << n;
    EXPECT_EQ(of(0), n >= 10 && n < 14 ? -2.0 : 0.0) << n;
    EXPECT_EQ(of(1), 0.0);
  }
  EXPECT_EQ(calls, 3);
}

TEST(TorqueSchedule, RisesAndFallsInStraightLinesAndAddsUp) {
  int calls = 0;
  const auto played = Played(
      {Torque("gear", 0.002, 4.0, 0.010, 0.004), Torque("gear", 0.008, 1.0, 0.002)}, 30, calls);
  const std::map<std::size_t, double> expected{{2, 0.0},  {3, 1.0},  {4, 2.0},  {5, 3.0},
                                               {6, 4.0},  {8, 5.0},  {9, 5.0},  {10, 4.0},
                                               {12, 4.0}, {13, 3.0}, {15, 1.0}, {16, 0.0}};
  for (const auto& [n, torque_n_m] : expected) {
    const auto found = played[n].find(1);
    EXPECT_NEAR(found == played[n].end() ? 0.0 : found->second, torque_n_m, 1e-12) << n;
  }
}

// Four cycles of a ramp of eight: half of it, and back from there without a jump.
TEST(TorqueSchedule, ThatIsShorterThanItsRampFallsFromWhatItHasReached) {
  int calls = 0;
  const auto played = Played({Torque("gear", 0.0, 8.0, 0.004, 0.008)}, 20, calls);
  EXPECT_NEAR(played[3].at(1), 3.0, 1e-12);
  EXPECT_NEAR(played[4].at(1), 4.0, 1e-12);
  EXPECT_NEAR(played[6].at(1), 2.0, 1e-12);
  EXPECT_NEAR(played[8].at(1), 0.0, 1e-12);
}

TEST(TorqueSchedule, OfAnInertiaThatIsNotThereIsRefusedWithThoseThatAre) {
  const auto refused = [](const std::string& inertia, const std::vector<std::string>& of_rig) {
    try {
      const TorqueSchedule schedule({Torque(inertia, 0.0, 1.0)}, of_rig, kTorquePeriod_s);
      return std::string("accepted");
    } catch (const std::invalid_argument& problem) {
      return std::string(problem.what());
    }
  };
  EXPECT_THAT(refused("propeller", kInertias), testing::HasSubstr("there are motor, gear, brake"));
  EXPECT_THAT(refused("gear", {"gear", "gear"}), testing::HasSubstr("two torsional inertias"));
  EXPECT_THAT(refused("gear", {}),
              testing::HasSubstr("no shaft of the rig has torsional inertias"));
}

}  // namespace
}  // namespace levitas::events
