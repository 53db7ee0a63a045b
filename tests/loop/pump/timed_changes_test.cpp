// Effects that a scenario changes while the rig runs: a slow drift and a sudden crack, each beside
// the same run without it.

#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <vector>

#include "plant_sim/effect/catalogue.hpp"
#include "tests/support/shipped_loop.hpp"

namespace levitas::test {
namespace {

using Complex = std::complex<double>;

constexpr double kPeriod_s = 1e-4;
constexpr double kSpeed_rad_per_s = 2.0 * std::numbers::pi * 25.0;
constexpr double kEventAt_s = 4.0;

struct Seen {
  double time_s{};
  double angle_rad{};
  Complex orbit_m;  ///< at the nde sensors
};

/// The flexible rotor at 1500 rpm from about 2.5 s to 7 s, with one effect in its file that has no
/// strength, and the change, if any.
std::vector<Seen> Played(const effect::EffectConfig& entry,
                         const std::vector<ScheduledRigEvent>& events) {
  ShippedLoop loop("flexible_rotor", "levitate");
  loop.rig.plant.effects = {entry};
  loop.rig.plant.effects[0].strength = 0.0;
  loop.scenario.steps.front().hold_s = 0.2;
  scenario::Step spin;
  spin.command = OperatorCommand::kSpin;
  spin.speed_rad_per_s = kSpeed_rad_per_s;
  spin.acceleration_rad_per_s2 = loop.rig.plant.drive.max_acceleration_rad_per_s2;
  spin.wait = scenario::Wait::kSpeedReached;
  spin.timeout_s = 5.0;
  spin.hold_s = 10.0;
  loop.scenario.steps = {loop.scenario.steps.front(), spin};
  loop.scenario.rig_events = events;
  std::vector<Seen> seen;
  const std::string end = loop.Play(20261121, 7.0, [&](const cycle::CycleRecord& record) {
    seen.push_back({static_cast<double>(record.in.cycle) * kPeriod_s,
                    record.in.frame.angle_rad,
                    {record.in.frame.position_m[2], record.in.frame.position_m[3]}});
  });
  EXPECT_EQ(end, "not finished");  // cut off by the time, not by a trip
  EXPECT_EQ(loop.most.contact_n, 0.0);
  return seen;
}

ScheduledRigEvent Change(const std::string& id, double ramp_s) {
  ScheduledRigEvent event;
  event.kind = RigEventKind::kEffect;
  event.effect = id;
  event.at_s = kEventAt_s;
  event.strength = 1.0;
  event.ramp_s = ramp_s;
  return event;
}

/// Line at `order` x rotation over ten turns of 400 samples, from `from_s` on.
Complex Line(const std::vector<Seen>& seen, int order, double from_s) {
  constexpr int kSamples = 4000;
  Complex line = 0.0;
  int count = 0;
  for (const Seen& s : seen) {
    if (s.time_s < from_s || count == kSamples) continue;
    line += s.orbit_m * std::polar(1.0 / kSamples, -order * s.angle_rad);
    ++count;
  }
  EXPECT_EQ(count, kSamples);
  return line;
}

effect::EffectConfig Unbalance() {
  effect::EffectConfig entry;
  entry.id = effect::Id::kUnbalance;
  entry.values = {0.2992, 20e-6, 1.5};  // 20 g mm at the disc
  return entry;
}

effect::EffectConfig Crack() {
  effect::EffectConfig entry;
  entry.id = effect::Id::kBreathingCrack;
  entry.values = {0.23, 0.4, 0.0};  // 40 % of the diameter, between the bearings
  return entry;
}

TEST(TimedChange, OfASlowDriftIsHalfWayInTheMiddleOfItsRampAndStaysAtItsEnd) {
  const auto drifting = Played(Unbalance(), {Change("unbalance", 2.0)});
  const Complex before = Line(drifting, 1, kEventAt_s - 0.5);
  const Complex middle = Line(drifting, 1, kEventAt_s + 0.8);  // 0.4 s about the middle
  const Complex after = Line(drifting, 1, kEventAt_s + 2.1);
  const Complex later = Line(drifting, 1, kEventAt_s + 2.6);
  const double change_m = std::abs(after - before);
  EXPECT_GT(change_m, 1e-6);
  // 1 um of noise over 4000 samples is 0.016 um in a line, magnets' curvature a little more.
  EXPECT_LT(std::abs(middle - 0.5 * (before + after)), 0.04 * change_m);
  EXPECT_LT(std::abs(later - after), 0.04 * change_m);
  // The other half of the pair: an effect without strength that nothing changes.
  const auto without = Played(Unbalance(), {});
  EXPECT_LT(std::abs(Line(without, 1, kEventAt_s + 2.1) - Line(without, 1, kEventAt_s - 0.5)),
            0.04 * change_m);
}

TEST(TimedChange, OfASuddenCrackChangesNoBitBeforeItAndMultiplesOfRotationFromThereOn) {
  const auto cracked = Played(Crack(), {Change("breathing_crack", 0.0)});
  const auto sound = Played(Crack(), {});
  ASSERT_EQ(cracked.size(), sound.size());
  std::vector<Seen> added = cracked;
  double first_s = 1e9;
  for (std::size_t n = 0; n < added.size(); ++n) {
    added[n].orbit_m -= sound[n].orbit_m;
    if (added[n].orbit_m != 0.0) first_s = std::min(first_s, added[n].time_s);
  }
  // A force begins to move the rotor within the period; a step of the converter is 49 nm.
  EXPECT_GE(first_s, kEventAt_s);
  EXPECT_LT(first_s, kEventAt_s + 0.1);
  // Both runs have the same noise: what is left is the crack. It breathes once a turn under the
  // weight: 1 and 2 x rotation, the mean, and little else.
  const double from_s = kEventAt_s + 1.0;
  double power_m2 = 0.0;
  int count = 0;
  for (const Seen& s : added) {
    if (s.time_s < from_s || count == 4000) continue;
    power_m2 += std::norm(s.orbit_m) / 4000.0;
    ++count;
  }
  double in_lines_m2 = 0.0;
  for (int order = -1; order <= 3; ++order) in_lines_m2 += std::norm(Line(added, order, from_s));
  EXPECT_GT(std::abs(Line(added, 2, from_s)), 50e-9);
  EXPECT_GT(in_lines_m2, 0.9 * power_m2);  // the rest: last bits of converters that fall otherwise
}

TEST(TimedChange, OfAnEffectThatTheRigDoesNotHaveIsRefusedBeforeTheRun) {
  ShippedLoop loop("flexible_rotor", "levitate");
  loop.scenario.rig_events = {Change("breathing_crack", 0.0)};
  EXPECT_THROW((void)loop.Play(1, 1.0), std::exception);
}

}  // namespace
}  // namespace levitas::test
